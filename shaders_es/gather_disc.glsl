// The light's disc, seen from a receiver, behind an edge: how much of it, and which of its samples.
uniform usampler2D disc_masks; // see technique/disc_mask.h

const float TURN = 6.28318531;
const float SAMPLES = 64.0;

// Of y / x for 0 <= y <= x, with an error of 1e-5 (Abramowitz & Stegun 1964, 4.4.49).
float arc_tangent(float r)
{
	float q = r * r;
	return r * (0.9998660 + q * (-0.3302995 + q * (0.1801410 +
		q * (-0.0851330 + q * 0.0208351))));
}

// As atan(y, x) for x >= 0.
float right_angle_of(float y, float x)
{
	float far = max(x, abs(y));
	// Of nothing at all the angle is 0.
	float angle = arc_tangent(min(x, abs(y)) / max(far, 1e-30));
	angle = abs(y) > x ? 0.25 * TURN - angle : angle;
	return y < 0.0 ? -angle : angle;
}

// As atan(v.y, v.x), from 0 to a turn.
float angle_of(vec2 v)
{
	float angle = right_angle_of(v.y, abs(v.x));
	angle = v.x < 0.0 ? 0.5 * TURN - angle : angle;
	return angle < 0.0 ? angle + TURN : angle;
}

// The samples of a sector, in two words: those at angles from `low` on, up to less than half a turn
// above that.
uvec2 sector(float low, float high)
{
	int first = int(ceil(low * (SAMPLES / TURN) - 0.5));
	int count = clamp(int(ceil(high * (SAMPLES / TURN) - 0.5)) - first, 0, 32);
	// A shift by all 32 bits is undefined.
	uint run = count == 32 ? ~0u : (1u << count) - 1u;
	int shift = first & 31;
	uvec2 mask = uvec2(run << shift, shift == 0 ? 0u : run >> (32 - shift));
	return (first & 32) == 0 ? mask : mask.yx;
}

// The samples beyond a line whose foot from the disc's centre is at an angle and a distance.
uvec2 beyond(float angle, float distance)
{
	return textureLod(disc_masks, vec2(angle * (1.0 / TURN), distance), 0.0).xy;
}

// Counters of 64 samples, from -16 to 15: a plane for each bit of them.
struct counters {
	uvec2 ones, twos, fours, eights, sixteens;
};

// Adds 1 where the mask has a bit, and 2 where `two` has one; or with sign = all bits takes that away.
// No bit is in both.
void count(inout counters c, uvec2 mask, uvec2 two, uint sign)
{
	uvec2 carry = (c.ones ^ sign) & mask | two;
	c.ones ^= mask;
	mask = (c.twos ^ sign) & carry;
	c.twos ^= carry;
	carry = (c.fours ^ sign) & mask;
	c.fours ^= mask;
	mask = (c.eights ^ sign) & carry;
	c.eights ^= carry;
	c.sixteens ^= mask;
}

// Bits that are set in both words (Warren, Hacker's Delight, 5-1); bitCount() came with 3.1.
float bits_of(uvec2 v)
{
	v -= v >> 1 & 0x55555555u;
	v = (v & 0x33333333u) + (v >> 2 & 0x33333333u);
	uint both = v.x + v.y;
	both = (both & 0x0f0f0f0fu) + (both >> 4 & 0x0f0f0f0fu);
	return float(both * 0x01010101u >> 24);
}

// How edges that border on other blockers count against those that border on what is not covered.
const float INNER_EDGES = 1.5;

// The share of the disc that the union of all blockers covers, of which `sum` is the sum. The samples
// tell what is covered twice; what they are off by along edges is known from the sum, and counts as
// far as edges border on what is not covered, not on other blockers: edges grow with the roots of
// what they enclose.
float covered_share(counters c, float sum)
{
	uvec2 some = c.ones | c.twos | c.fours | c.eights;
	uvec2 positive = ~c.sixteens & some;
	uvec2 several = c.sixteens | c.eights | c.twos | c.fours;
	float total = bits_of(c.ones) + 2.0 * bits_of(c.twos) + 4.0 * bits_of(c.fours) +
		8.0 * bits_of(c.eights) - 16.0 * bits_of(c.sixteens);
	float covered = bits_of(positive), twice = bits_of(several);
	float outer = sqrt(SAMPLES - covered), inner = INNER_EDGES * sqrt(twice);
	// Without any that are covered twice it is the sum.
	float exposed = twice > 0.0 ? outer / (outer + inner) : 1.0;
	return covered / SAMPLES + (sum - total / SAMPLES) * exposed;
}
