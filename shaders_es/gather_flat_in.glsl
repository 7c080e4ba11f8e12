// What gather_flat_out.glsl hands on, by the uniforms' names.
#ifdef FLAT_INPUTS
flat in vec4 flat_screen, flat_depth, flat_map, flat_disc, flat_lists;

#define screen_w flat_screen.xyz
#define screen_scale flat_screen.w
#define screen_depth flat_depth.xyz
#define pole flat_depth.w
#define map_size vec2(flat_map.x, 1.0 / flat_map.x)
#define bias_limit flat_map.yz
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
