// Joins points of the sparse picture to cells: each has a point at each corner, and between them one
// surface, whose visibility is smooth.
uniform usampler2D point_map;
uniform vec2 cell_depth; // how far off its plane a cell's surface may be, at window depth d: x + y d

layout(location = 0) out uvec4 packed_cell;

// Second differences of visibility that are still smooth, differences that a penumbra wide enough
// for the points can have, and those that need no second ones.
const float MOST_BEND = 0.12;
const float MOST_RISE = 0.55;
const float FLAT = 0.02;

struct point {
	float depth, v;
	float wide; // 1: no penumbra that is narrow for the points' spacing is near; zink has no arrays of
		    // structures with a bool
};

// Beyond the picture's rim that there. As in gather_textures.glsl texelFetch() would be dearer.
point point_at(vec2 pixel)
{
	uvec2 p = textureLod(point_map, pixel / vec2(textureSize(point_map, 0)), 0.0).xy;
	return point(uintBitsToFloat(p.x), float(p.y & 0xffffu) / 65535.0, float(p.y >> 16 != 0u));
}

// What v bends by between p and q, from those of the points beyond them on one line that count.
float bend_of(point before, point p, point q, point after, vec2 counts)
{
	vec2 bends = vec2(before.v - 2.0 * p.v + q.v, p.v - 2.0 * q.v + after.v);
	return dot(counts, bends) / max(counts.x + counts.y, 1.0);
}

// The point itself, and what it changes by over the cell in x and y.
vec3 plane_through(point p[16])
{
	float x = 0.5 * (p[6].depth - p[5].depth + p[10].depth - p[9].depth);
	float y = 0.5 * (p[9].depth - p[5].depth + p[10].depth - p[6].depth);
	float middle = 0.25 * (p[5].depth + p[6].depth + p[9].depth + p[10].depth);
	return vec3(middle - 0.5 * (x + y), x, y);
}

// How far off the plane a point is.
float off_plane(point p, vec3 plane, int i)
{
	return abs(p.depth - plane.x - plane.y * float((i & 3) - 1) - plane.z * float((i >> 2) - 1));
}

// sides: from how many, along each axis, it is known how v bends.
bool is_smooth(vec4 v, vec2 bend, vec2 sides)
{
	vec4 rise = abs(v.ywzw - v.xzxy);
	vec2 most = max(rise.xz, rise.yw);
	vec2 limit = mix(vec2(FLAT), vec2(MOST_RISE), min(sides, 1.0));
	return all(lessThan(most, limit)) && all(lessThanEqual(abs(bend), 0.5 * MOST_BEND * sides));
}

void main()
{
	// Of four by four points those in the middle are the cell's corners.
	point p[16];
	for (int i = 0; i < 16; i++)
		p[i] = point_at(gl_FragCoord.xy + vec2(i & 3, i >> 2) - 1.0);
	vec3 plane = plane_through(p);
	float tolerance = cell_depth.x + cell_depth.y * plane.x;
	float off_corners = 0.0;
	vec2 off_before = vec2(0.0), off_after = vec2(0.0);
	for (int i = 0; i < 16; i++) {
		bvec2 within = bvec2((i & 3) % 3 != 0, (i >> 2) % 3 != 0);
		float off = off_plane(p[i], plane, i);
		off_corners = within.x && within.y ? max(off_corners, off) : off_corners;
		off_before.x = within.y && (i & 3) == 0 ? max(off_before.x, off) : off_before.x;
		off_before.y = within.x && (i >> 2) == 0 ? max(off_before.y, off) : off_before.y;
		off_after.x = within.y && (i & 3) == 3 ? max(off_after.x, off) : off_after.x;
		off_after.y = within.x && (i >> 2) == 3 ? max(off_after.y, off) : off_after.y;
	}
	bool whole = off_corners < tolerance && p[5].wide * p[6].wide * p[9].wide * p[10].wide > 0.0;
	// Where the surface goes on at the points beyond they tell how visibility bends.
	vec2 before = vec2(lessThan(off_before, vec2(4.0 * tolerance)));
	vec2 after = vec2(lessThan(off_after, vec2(4.0 * tolerance)));
	vec2 along_x = vec2(before.x, after.x), along_y = vec2(before.y, after.y);
	vec2 bend = 0.5 * vec2(bend_of(p[4], p[5], p[6], p[7], along_x) +
		bend_of(p[8], p[9], p[10], p[11], along_x),
		bend_of(p[1], p[5], p[9], p[13], along_y) +
		bend_of(p[2], p[6], p[10], p[14], along_y));
	vec4 v = vec4(p[5].v, p[6].v, p[9].v, p[10].v);
	bool known = whole && is_smooth(v, bend, before + after);
	cell found = cell(plane.x, plane.y, plane.z, v, bend);
	packed_cell = known ? pack_cell(found) : CELL_UNKNOWN;
}
