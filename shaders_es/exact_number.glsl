// Numbers of at least 0 as bits, in integers alone, so that every driver computes the same: the
// bits are ordered as the numbers are. One file of a precision follows (exact_fixed12.glsl,
// exact_half.glsl); src/fixed/number.h has the same functions.
uint num_mul(uint a, uint b);
uint num_add(uint a, uint b);
uint num_rest(uint a); // 1 - a; a <= 1

// Of a, b, t <= 1. No more than 1: neither product rounds to more than its weight.
uint num_lerp(uint a, uint b, uint t)
{
	return num_add(num_mul(a, num_rest(t)), num_mul(b, t));
}

// x: floor(n 2^bits / d), which must fit; y: the remainder. n < 2 d < 2^31. By hand, since not
// every processor divides integers.
uvec2 divide(uint n, uint d, int bits)
{
	uvec2 q = n >= d ? uvec2(1u, n - d) : uvec2(0u, n);
	for (int i = 0; i < bits; i++) {
		q *= 2u;
		q = q.y >= d ? uvec2(q.x + 1u, q.y - d) : q;
	}
	return q;
}
