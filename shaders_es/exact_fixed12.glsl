// Numbers of s1.10 fixed point, at least 0: steps of 1/1024, to the nearest, halves up, saturating.
const uint NUM_ONE = 1024u;
const uint NUM_MAX = 2047u;

// Of integers below 2^22.
uint num_ratio(uint n, uint d)
{
	if (n >= 2u * d)
		return NUM_MAX;
	uvec2 q = divide(n, d, 10);
	return min(q.x + (2u * q.y >= d ? 1u : 0u), NUM_MAX);
}

// By 0: the largest.
uint num_div(uint a, uint b)
{
	return num_ratio(a, b);
}

uint num_mul(uint a, uint b)
{
	return min((a * b + 512u) >> 10, NUM_MAX);
}

uint num_add(uint a, uint b)
{
	return min(a + b, NUM_MAX);
}

uint num_rest(uint a)
{
	return NUM_ONE - a;
}

// f / 1024; f < 1024.
uint num_weight(uint f)
{
	return f;
}

// 1024 a; a <= 1.
uint num_index(uint a)
{
	return a;
}

// 65535 a; a <= 1.
uint num_bytes(uint a)
{
	return (a * 65535u + 512u) >> 10;
}
