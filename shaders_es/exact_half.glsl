// Numbers of IEEE 754 binary16, at least 0 and finite: the exact result of each operation rounded
// once, to nearest, ties to even, and saturating at 65504.
const uint NUM_ONE = 0x3C00u;
const uint NUM_MAX = 0x7BFFu;

const uint HALF_HIDDEN = 0x400u; // the digit that normal numbers do not store

// A number as digits below 2 HALF_HIDDEN, in units of 2^exponent.
uint half_digits(uint a)
{
	return a < HALF_HIDDEN ? a : (a & (HALF_HIDDEN - 1u)) | HALF_HIDDEN;
}

int half_exponent(uint a)
{
	return int(max(a >> 10, 1u)) - 25;
}

// Place of the highest bit of n > 0.
int half_highest_bit(uint n)
{
	int place = n >> 16 != 0u ? 16 : 0;
	place += n >> (place + 8) != 0u ? 8 : 0;
	place += n >> (place + 4) != 0u ? 4 : 0;
	place += n >> (place + 2) != 0u ? 2 : 0;
	return place + (n >> (place + 1) != 0u ? 1 : 0);
}

// The number nearest to n 2^exponent; n < 2^31, exponent >= -55. A lowest bit that stands for all
// that is below it is enough, if n has 13 bits or more.
uint half_round(uint n, int exponent)
{
	if (n == 0u)
		return 0u;
	int last = max(half_highest_bit(n) + exponent - 10, -24); // of the digits that are kept
	if (last > 5)
		return NUM_MAX;
	int shift = last - exponent;
	uint digits;
	if (shift <= 0) {
		digits = n << -shift;
	} else {
		digits = n >> shift;
		uint rest = n - (digits << shift), tie = 1u << (shift - 1);
		if (rest > tie || (rest == tie && (digits & 1u) == 1u))
			digits++;
	}
	// The hidden digit carries into the exponent, and so does rounding up to a power of two.
	return min((uint(last + 24) << 10) + digits, NUM_MAX);
}

// By 0: the largest.
uint num_div(uint a, uint b)
{
	if (a == 0u || b == 0u)
		return b == 0u ? NUM_MAX : 0u;
	uint n = half_digits(a), d = half_digits(b);
	int up = 10 - half_highest_bit(n), down = 10 - half_highest_bit(d);
	uvec2 q = divide(n << up, d << down, 13);
	return half_round(2u * q.x + (q.y != 0u ? 1u : 0u),
		half_exponent(a) - up - half_exponent(b) + down - 14);
}

// Of integers below 2^22, which are rounded to 11 bits first.
uint num_ratio(uint n, uint d)
{
	return num_div(half_round(n, -21), half_round(d, -21));
}

uint num_mul(uint a, uint b)
{
	return half_round(half_digits(a) * half_digits(b), half_exponent(a) + half_exponent(b));
}

uint num_add(uint a, uint b)
{
	uint large = max(a, b), small = min(a, b);
	int shift = half_exponent(large) - half_exponent(small);
	if (shift > 12)
		return large; // the other is below a quarter of its last digit
	return half_round((half_digits(large) << shift) + half_digits(small), half_exponent(small));
}

uint num_rest(uint a)
{
	// At most 14 places.
	int shift = half_exponent(NUM_ONE) - half_exponent(a);
	return half_round((HALF_HIDDEN << shift) - half_digits(a), half_exponent(a));
}

// f / 1024; f < 1024.
uint num_weight(uint f)
{
	return half_round(f, -10);
}

// factor a to the nearest integer, halves up; a <= 1.
uint half_scale(uint a, uint factor)
{
	int shift = -half_exponent(a);
	return (half_digits(a) * factor + (1u << (shift - 1))) >> shift;
}

uint num_index(uint a)
{
	return half_scale(a, 1024u);
}

uint num_bytes(uint a)
{
	return half_scale(a, 65535u);
}
