// Lists of edges, in textures.
uniform usampler2D edge_runs; // struct edge_run of scene/edge_lists.h, TABLE_ROW a row
uniform usampler2D edge_map;  // struct edge_texel of scene/edge_texel.h, as many a row

const float TABLE_ROW = 1024.0;

// Textures are looked up where texels have their middles: texelFetch() is the same, but twice as dear
// to llvmpipe, which finds level, size and stride of each lane. rows: 1 / those of the table.
vec2 table_place(int i, float rows)
{
	float at = (float(i) + 0.5) * (1.0 / TABLE_ROW), row = floor(at);
	return vec2(at - row, (row + 0.5) * rows);
}

float row_share(ivec2 table)
{
	return 1.0 / float(table.y);
}

// What the next two take, found once for many.
float run_rows()
{
	return row_share(textureSize(edge_runs, 0));
}

float edge_rows()
{
	return row_share(textureSize(edge_map, 0));
}

uvec4 run_at(int i, float rows)
{
	return textureLod(edge_runs, table_place(i, rows), 0.0);
}

uvec4 edge_at(int i, float rows)
{
	return textureLod(edge_map, table_place(i, rows), 0.0);
}
