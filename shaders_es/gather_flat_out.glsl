// As screen_flat_out.glsl has the screen, what pixels that walk along edges read.
#ifdef FLAT_INPUTS
flat out vec4 flat_disc, flat_lists;

#define HANDS_ON_EDGES
void hand_on_edges()
{
	hand_on_screen(vec2(pole, casts));
	flat_disc = vec4(disc_scale, disc_facing, snap, raster_snap);
	flat_lists = vec4(tile_count, layer_count, hollow_base, depth_noise);
}
#endif
