// A cell of the sparse picture: four points of the view, a few pixels apart, whose visibility is
// known, and the surface between them. See src/sparse_pass.h.
const float CELL_STEPS = 4095.0; // of visibility
const float BEND_STEPS = 254.0;  // of how much it bends, from -1/2 to 1/2, with 0 as one of them

struct cell {
	float depth, depth_x, depth_y; // of the camera's window, at the first point; over the cell
	vec4 v;                        // at points (0,0), (1,0), (0,1), (1,1)
	vec2 bend;                     // second differences of v
};

// A cell that no surface is of.
const uvec4 CELL_UNKNOWN = uvec4(0x7149f2cau, 0u, 0u, 0u); // a depth of 1e30

uvec4 pack_cell(cell c)
{
	uvec4 v = uvec4(c.v * CELL_STEPS + 0.5);
	uvec2 bend = uvec2((clamp(c.bend, -0.5, 0.5) + 0.5) * BEND_STEPS + 0.5);
	return uvec4(floatBitsToUint(c.depth), packHalf2x16(vec2(c.depth_x, c.depth_y)),
		v.x | v.y << 12 | bend.x << 24, v.z | v.w << 12 | bend.y << 24);
}

cell unpack_cell(uvec4 words)
{
	vec2 slope = unpackHalf2x16(words.y);
	vec4 v = vec4(words.z & 4095u, words.z >> 12 & 4095u, words.w & 4095u,
		words.w >> 12 & 4095u);
	return cell(uintBitsToFloat(words.x), slope.x, slope.y, v / CELL_STEPS,
		vec2(words.z >> 24, words.w >> 24) / BEND_STEPS - 0.5);
}
