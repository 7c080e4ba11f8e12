// Visibility between the points of the sparse picture.
uniform usampler2D cell_map;
uniform vec2 cell_depth; // see sparse_cells.frag

// Whether a pixel is of its cell's surface; v is the visibility then. at: in cells; seen: the
// camera's depth.
bool is_of_cell(vec2 at, float seen, out float v)
{
	vec2 f = fract(at);
	vec2 middle = (floor(at) + 0.5) / vec2(textureSize(cell_map, 0));
	cell c = unpack_cell(textureLod(cell_map, middle, 0.0));
	float depth = c.depth + c.depth_x * f.x + c.depth_y * f.y;
	vec2 row = mix(c.v.xz, c.v.yw, f.x);
	v = clamp(mix(row.x, row.y, f.y) - 0.5 * dot(c.bend, f * (1.0 - f)), 0.0, 1.0);
	return abs(seen - depth) < cell_depth.x + cell_depth.y * depth;
}
