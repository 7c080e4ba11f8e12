// What all pixels of a light read, handed on to them by vertices, where a driver is slow at uniforms: a
// fragment shader of llvmpipe gathers each component lane by lane, 26 instructions for 8 pixels; what is
// flat it has by two, and vertices and triangles are few beside pixels.
#ifdef FLAT_INPUTS
flat out vec4 flat_screen, flat_depth, flat_map, flat_disc, flat_lists;

#define HANDS_ON
void hand_on()
{
	flat_screen = vec4(screen_w, screen_scale);
	flat_depth = vec4(screen_depth, pole);
	flat_map = vec4(map_size.x, bias_limit, casts);
	flat_disc = vec4(disc_scale, disc_facing, snap, raster_snap);
	flat_lists = vec4(tile_count, layer_count, hollow_base, depth_noise);
}
#endif
