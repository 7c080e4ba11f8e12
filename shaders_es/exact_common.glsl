// Edges and values of primitives (src/fixed/primitive.h), in integers alone: nothing is
// interpolated.
flat in ivec4 primitive[PRIMITIVE_TEXELS - 1];

const uint DEPTH_ONE = 1u << 21;
const int DEPTH_FRACTION = 9;

// For the depth buffer: exact in a float, and in order in 24 bits.
const float DEPTH_STEP = 1.0 / 2097152.0;

// At a pixel, modulo 2^32.
int plane_at(ivec3 plane, ivec2 pixel)
{
	return plane.x + pixel.x * plane.y + pixel.y * plane.z;
}

// Four planes, one after the other.
ivec4 planes_at(ivec4 a, ivec4 b, ivec4 c, ivec2 pixel)
{
	return ivec4(a.x, a.w, b.z, c.y) + pixel.x * ivec4(a.y, b.x, b.w, c.z) +
	       pixel.y * ivec4(a.z, b.y, c.x, c.w);
}

bool covers(ivec2 pixel)
{
	ivec4 edges = planes_at(primitive[0], primitive[1], primitive[2], pixel);
	return (edges.x | edges.y | edges.z | edges.w) >= 0;
}

uint depth_range(int plane)
{
	return uint(clamp(plane, 0, (1 << 30) - 1));
}

uint window_depth(int plane)
{
	return depth_range(plane) >> DEPTH_FRACTION;
}
