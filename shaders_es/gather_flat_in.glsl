// What gather_flat_out.glsl hands on, by the uniforms' names.
#ifdef FLAT_INPUTS
flat in vec4 flat_disc, flat_lists;

#define pole flat_depth.w
#define casts (flat_map.w > 0.0)
#define disc_scale flat_disc.x
#define disc_facing flat_disc.y
#define snap flat_disc.z
#define raster_snap flat_disc.w
#define tile_count flat_lists.x
#define layer_count int(flat_lists.y)
#define hollow_base int(flat_lists.z)
#define depth_noise flat_lists.w
#endif
