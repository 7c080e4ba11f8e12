// Lists of edges, in images: what gather_textures.glsl has in textures. Units: enum image_unit of
// gles/texture_unit.h.
layout(rgba32ui, binding = 0) uniform readonly highp uimage2D run_image;
layout(rgba32ui, binding = 1) uniform readonly highp uimage2D edge_image;

// Of 1024 a row.
ivec2 table_place(int i)
{
	return ivec2(i & 1023, i >> 10);
}

float run_rows()
{
	return 0.0; // not needed
}

float edge_rows()
{
	return 0.0;
}

uvec4 run_at(int i, float rows)
{
	return imageLoad(run_image, table_place(i));
}

uvec4 edge_at(int i, float rows)
{
	return imageLoad(edge_image, table_place(i));
}
