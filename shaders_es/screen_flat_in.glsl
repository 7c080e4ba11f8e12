// What screen_flat_out.glsl hands on, by the uniforms' names.
#ifdef FLAT_INPUTS
flat in vec4 flat_screen, flat_depth, flat_map;

#define screen_w flat_screen.xyz
#define screen_scale flat_screen.w
#define screen_depth flat_depth.xyz
#define map_size vec2(flat_map.x, 1.0 / flat_map.x)
#define bias_limit flat_map.yz
#endif
