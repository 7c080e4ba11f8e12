// What all pixels of a light read, handed on to them by vertices. A fragment shader of llvmpipe gathers
// each component of a uniform lane by lane, 26 instructions for 8 pixels; what is flat it has by two, and
// vertices and triangles are few beside pixels.
uniform bool casts;        // the receiver, as well
uniform float disc_scale;  // radius of the disc, window x or y, over the depth before the receiver
uniform float disc_facing; // what window x or y are of the tangent to the light's axis; or 0
uniform float pole;        // K, see scene/light.h
uniform float snap;        // by how much points of edges and sheets are moved, window x or y
uniform float raster_snap; // and by the raster grid, which the outlines of sheets follow
uniform float depth_noise; // of vertices far from their origin, whose floats are coarse
uniform float tile_count;  // a side
uniform int layer_count;   // what more there would be is empty
uniform int hollow_base;   // texel of the edge map from which on triangles over hollows are

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
