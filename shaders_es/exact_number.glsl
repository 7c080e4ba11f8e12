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

// One more binary digit of a quotient, x, and what is left, y.
uvec2 divide_digit(uvec2 q, uint d)
{
	q *= 2u;
	return q.y >= d ? uvec2(q.x + 1u, q.y - d) : q;
}

uvec2 divide_5_digits(uvec2 q, uint d)
{
	q = divide_digit(divide_digit(q, d), d);
	return divide_digit(divide_digit(divide_digit(q, d), d), d);
}

// x: floor(n 2^bits / d), which must fit; y: the remainder. n < 2 d < 2^31; bits: 10, 13, 20 or 21.
// By hand, since not every processor divides integers, and without loops, since the compiler of
// llvmpipe takes minutes for a few of them.
uvec2 divide(uint n, uint d, int bits)
{
	uvec2 q = n >= d ? uvec2(1u, n - d) : uvec2(0u, n);
	q = divide_5_digits(divide_5_digits(q, d), d);
	if (bits == 13)
		q = divide_digit(divide_digit(divide_digit(q, d), d), d);
	if (bits >= 20)
		q = divide_5_digits(divide_5_digits(q, d), d);
	if (bits == 21)
		q = divide_digit(q, d);
	return q;
}
