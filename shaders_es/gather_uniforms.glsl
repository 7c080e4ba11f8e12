// What pixels that walk along edges read of a light.
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
