// Silhouette edges as data: the share of the light's disc that blockers cover is the number of
// sheets before the disc's centre, and a term for each edge before the disc. Everything is in window
// coordinates of the light's screen, on which edges are straight, also in depth.
uniform usampler2D edge_tiles; // struct edge_tile of scene/edge_grid.h
uniform usampler2D front_layer; // see gather_layer.frag
uniform usampler2D second_layer;
uniform usampler2D third_layer;

const int LAYERS_MOST = 3;
#ifdef TWO_LAYERS
const int LAYERS = 2;
#else
const int LAYERS = LAYERS_MOST;
#endif
// Of edges.
const int DEPTH_BITS = 11;
const uint DEPTH_MASK = 2047u;
const float DEPTH_STEPS = 4194304.0;
const float BOX_STEPS = 65536.0;
const uvec2 BOX_SHIFT = uvec2(0u, 16u);
// Sheets that the counters have room for; behind more nothing is lit.
const int WINDING_MAX = 15;
// So many leave nothing to edges.
const int HIDDEN = 1024;
// Of a triangle over a hollow, and steps of its depths.
const int HOLLOW_TEXELS = 4;
const float HOLLOW_DEPTHS = 65536.0;

float cross_of(vec2 a, vec2 b)
{
	return a.x * b.y - a.y * b.x;
}

#ifdef POINTS
// A penumbra at least this many times as wide, from its middle, as points are apart shows in them.
const float WIDTH_SHOWN = 1.25;
// Whether visibility between the point and the next ones does not show in them.
bool narrow_penumbra = false;
#endif

// The disc of a spot faces the receiver, whose light comes in along (e, 1): seen from there what is
// beside it by v on the screen is beside it by E v = v - k e (e v), and as much farther before it as
// it is before a plane with the slope `tilt` through the receiver.
struct receiver {
	vec3 s;
	vec2 slope;  // of its own plane
	bool casts_too;
	float noise; // of depths on that plane
	vec2 e, tilt;
	float k, shrink; // shrink: determinant of E
	float spacing;   // to the next pixel
};

receiver receiver_of(vec3 s, vec2 slope, bool casts_too, float spacing)
{
	vec2 e = (s.xy - 0.5) * disc_facing;
	float square = 1.0 + dot(e, e), root = sqrt(square);
	float noise = max(DEPTH_STEP, depth_noise) + snap * (abs(slope.x) + abs(slope.y));
	vec2 tilt = e * (disc_facing * (pole - s.z) / square);
	return receiver(s, slope, casts_too, noise, e, tilt, 1.0 / (square + root), 1.0 / root,
		spacing);
}

vec2 faced(receiver r, vec2 v)
{
	return v - r.e * (dot(r.e, v) * r.k);
}

// Depth over window x or y, of what is kept. The bits of a half within those of a float are it times
// 2^-112: exactly, but that what is below 6.2e-5 may be 0.
vec2 slope_of(uint halves)
{
	const float SCALE = 5.192296858534828e33 / SLOPE_SCALE;
	ivec2 bits = ivec2(int(halves << 16), int(halves)) >> 3 & int(0x8fffe000u);
	return intBitsToFloat(bits) * (map_size.x * SCALE);
}

// A sheet at a texel of the layers.
struct sheet {
	float depth;
	vec2 slope;
};

sheet sheet_of(uvec4 texel)
{
	return sheet(uintBitsToFloat(texel.x), slope_of(texel.y));
}

// Those at a texel of each layer, nearest first.
struct sheets {
	sheet of[LAYERS];
};

sheets sheets_at(vec2 at)
{
	sheets found;
	found.of[0] = sheet_of(textureLod(front_layer, at, 0.0));
	found.of[1] = sheet_of(textureLod(second_layer, at, 0.0));
#ifndef TWO_LAYERS
	found.of[2] = sheet_of(textureLod(third_layer, at, 0.0));
#endif
	return found;
}

float noise_of(sheet sheet, receiver r)
{
	return r.noise + snap * (abs(sheet.slope.x) + abs(sheet.slope.y));
}

// How far a sheet, at a texel that is `off` from the receiver, is before it: the plane of the sheet
// before the receiver, and the sheet itself before the receiver's plane. The first is greater by how
// the planes turn away from each other on the way, as a sum at most by `turn`.
struct lead {
	float here, there, turn;
};

lead lead_of(sheet sheet, receiver r, vec2 off)
{
	float here = r.s.z - sheet.depth + dot(sheet.slope, off);
	float there = r.s.z - sheet.depth + dot(r.slope, off);
	return lead(here, there, dot(abs(sheet.slope - r.slope), abs(off)));
}

// Whether the sheet is before the receiver: on its own plane, which leaves a floor beside a wall lit,
// and as seen from the receiver's, which leaves a curved surface lit.
bool blocks(lead lead, float noise)
{
	return min(lead.here, lead.there) > noise;
}

// How far the sheet is from where the receiver's own would be, where from 1 on it is another: one
// that bends once on the way is behind the receiver's plane, or before it, by none to all of what
// it turns.
float strangeness(lead lead, receiver r)
{
	float apart = abs(mix(lead.there, lead.here, 0.25));
	return max(apart - r.noise, 0.0) / (lead.turn + r.noise);
}

// How doubtful it is, to 1, whether a sheet that is not the receiver's own is before it: they may
// meet on the way, where no edge tells.
float doubt(lead lead, float noise)
{
	float sure = min(lead.here, lead.there) / (lead.turn + noise);
	return max(lead.here, lead.there) > noise ? 1.0 - clamp(sure, 0.0, 1.0) : 0.0;
}

// A point from which the winding number is carried to the receiver, and what it is there. Edges in
// between count where they are before `depth`, and before a plane through it at the receiver; others
// are of the receiver's own sheet, if they are behind the farther of the two by `own_depth` at most:
// nothing behind `deepest` is. Where that begins on the way from a texel that does not have it, its
// plane means nothing there: `seen` sheets are before the receiver.
struct origin {
	vec2 at;
	int winding, seen;
	float depth, own_depth, deepest;
	vec2 slope;
};

// The search ends at a texel whose sheet is no stranger, doubt of the others added; one farther off
// is better by so much less.
const float GOOD = 0.02;
const float BETTER = 0.2;
// Worse than any texel that has it.
const float NOT_FOUND = 3.0;
// A sheet at a texel that has no other is rather the receiver's own: so strange it may be.
const float STRANGE_ALONE = 2.0;

// The sheets before the receiver at the nearest texel; if it casts itself, at that of the four
// nearest where its own sheet is best found among them, which is left out. tries: 4, 1, or 0 to leave
// it all as it is. Loops of this file test at their ends, too: a processor with lanes leaves them
// nowhere else, so that a test at the start alone costs a round in which no lane does anything.
origin origin_among(receiver r, origin middle, int tries)
{
	vec2 place = r.s.xy * map_size.x, nearest = floor(place);
	vec2 side = place - nearest - 0.5;
	vec2 beside = vec2(side.x < 0.0 ? -1.0 : 1.0, side.y < 0.0 ? -1.0 : 1.0);
	bool x_first = abs(side.x) >= abs(side.y);
	// Of the best texel so far.
	float best = NOT_FOUND;
	vec2 aside = vec2(0.0);
	int blocking_there = 0, before_there = 0;
	for (int i = 0; i < tries;) {
		vec2 step = vec2(float(i & 1), float(i >> 1));
		vec2 texel = nearest + beside * (x_first ? step : step.yx);
		texel = clamp(texel, vec2(0.0), vec2(map_size.x - 1.0));
		vec2 at = (texel + 0.5) * map_size.y, off = at - r.s.xy;
		sheets sheets = sheets_at(at);
		lead leads[LAYERS];
		bool alone = layer_count < 2 || sheets.of[1].depth > 1.0;
		float strange = NOT_FOUND, limit = alone ? STRANGE_ALONE : 1.0;
		int own_layer = -1;
		for (int j = 0; j < LAYERS; j++) {
			leads[j] = lead_of(sheets.of[j], r, off);
			float found = strangeness(leads[j], r);
			bool nearer = r.casts_too && j < layer_count && found < strange;
			own_layer = nearer && found <= limit ? j : own_layer;
			strange = nearer ? found : strange;
		}
		float rise = dot(r.slope, off), doubts = 0.0;
		int blocking = 0, before = 0;
		for (int j = 0; j < LAYERS; j++) {
			bool counts = j < layer_count;
			// Of sheets that all but lie on each other the layers tell the order.
			float noise = j < own_layer ? r.noise : noise_of(sheets.of[j], r);
			float nearer = leads[j].there - min(rise, 0.0);
			before += int(counts && min(leads[j].here, nearer) > noise);
			counts = counts && j != own_layer;
			blocking += int(counts && blocks(leads[j], noise));
			doubts = max(doubts, counts ? doubt(leads[j], noise) : 0.0);
		}
		float score = own_layer >= 0 ? strange + doubts : NOT_FOUND;
		if (i == 0 || score < best - BETTER) {
			best = score;
			aside = off;
			blocking_there = blocking;
			before_there = before;
		}
		i++;
		if (i >= tries || best < GOOD)
			break;
	}
	// Where all layers are before the receiver more sheets may be: of what does not cast it is
	// taken that it lies behind all that are in line, and what does is dark where layers are
	// drawn no further.
	bool hidden = r.casts_too && blocking_there == LAYERS_MOST;
	if (tries == 0 || (!r.casts_too && blocking_there == layer_count))
		return middle;
	int winding = hidden ? HIDDEN : blocking_there;
	// Before all edges: none is looked at.
	float depth = hidden ? -1.0 : r.s.z - r.noise, own_depth = 2.0 * r.noise;
	float deepest = depth + own_depth + max(dot(r.slope, aside), 0.0);
	return origin(aside + r.s.xy, winding, hidden || !r.casts_too ? winding : before_there,
		depth, own_depth, deepest, r.slope);
}

origin origin_of(receiver r, uvec4 tile, vec2 tile_at)
{
	// Behind all that casts, where no map need be asked.
	int winding = int(tile.y >> 24) - 128;
	origin from = origin((tile_at + 0.5) / tile_count, winding, winding, 2.0, 0.0, 2.0, vec2(0.0));
#ifdef BEHIND
	return from; // as all that is drawn so
#endif
	bool among = light_arrives && r.s.z <= uintBitsToFloat(tile.w);
	return origin_among(r, from, !among ? 0 : r.casts_too ? 4 : 1);
}

// What is summed over the edges of a tile.
struct sums {
	int winding;  // gained on the way from the origin
	int own;      // of that by the receiver's own sheet
	float behind; // shares of the disc behind edges
	counters seen;
	bool any; // whether there is an edge before the disc
};

sums no_sums()
{
	uvec2 none = uvec2(0u);
	return sums(0, 0, 0.0, counters(none, none, none, none, none), false);
}

// A receiver as edges see it: x and y in steps of their grid from the middle of the screen, depths in
// steps of theirs.
struct eye {
	vec2 at;
	float depth;
	vec2 tilt;
	float radius;  // of the disc, x or y, over the depth before the receiver
	float inverse; // of that
	float most;    // square of what a point may be beside it that is before the disc, over that
#ifdef POINTS
	float spacing; // to the next pixel
#endif
};

eye eye_of(receiver r)
{
	float steps = 0.5 / snap;
	eye eye;
	eye.at = (r.s.xy - 0.5) * steps;
	eye.depth = r.s.z * DEPTH_STEPS;
	eye.tilt = r.tilt * (DEPTH_STEPS / steps);
	eye.radius = disc_scale * (steps / DEPTH_STEPS);
	eye.inverse = 1.0 / max(eye.radius, 1e-30);
	eye.most = eye.radius * eye.radius / (r.shrink * r.shrink);
#ifdef POINTS
	eye.spacing = r.spacing * steps;
#endif
	return eye;
}

// An edge as seen from the receiver, in the same steps: ends beside it, their depths and how far before
// it they are, and the doubled area between them and the receiver, above 0 where that has the edge's
// sheet on its side.
struct edge {
	vec2 a, b;
	float depth_a, depth_b, before_a, before_b, side;
};

// Of a struct edge_texel of scene/edge_texel.h.
edge edge_of(uvec4 texel, eye eye)
{
	vec4 ends = vec4(ivec4(texel) >> DEPTH_BITS) - eye.at.xyxy;
	uvec2 low = texel.yw & DEPTH_MASK;
	vec2 depths = vec2(ivec2((texel.xz & DEPTH_MASK) << DEPTH_BITS | low));
	float before_a = eye.depth - depths.x - dot(eye.tilt, ends.xy);
	float before_b = eye.depth - depths.y - dot(eye.tilt, ends.zw);
	return edge(ends.xy, ends.zw, depths.x, depths.y, before_a, before_b,
		cross_of(ends.xy, ends.zw));
}

// The part of the disc behind an edge is that between the edge's ends less the triangle before it.
// E is symmetric: (E a) u = a (E u), so that ends need not be faced. two: sheets end there.
void add_edge(inout sums sum, edge edge, bool two, receiver r, eye eye)
{
	vec2 along = faced(r, edge.before_a * edge.b - edge.before_b * edge.a);
	// Edges that are hit have a length.
	float shorten = inversesqrt(max(dot(along, along), 1e-37));
	vec2 u = along * shorten, seen = faced(r, u);
	float h = abs(edge.side) * r.shrink * shorten * eye.inverse;
	float half_chord = sqrt(max(1.0 - h * h, 0.0));
	// Ends in the receiver's plane are infinitely far off.
	float t0 = dot(edge.a, seen) * eye.inverse / max(edge.before_a, 1e-30);
	float t1 = dot(edge.b, seen) * eye.inverse / max(edge.before_b, 1e-30);
	t0 = edge.before_a > 0.0 ? max(t0, -half_chord) : -half_chord;
	t1 = edge.before_b > 0.0 ? min(t1, half_chord) : half_chord;
	bool before = h < 1.0 && t0 < t1;
	float sign = edge.side >= 0.0 ? 1.0 : -1.0;
	float low = right_angle_of(t0, h), high = right_angle_of(t1, h);
	float share = sign * (high - low - (t1 - t0) * h);
	sum.behind += before ? (two ? 2.0 * share : share) : 0.0;
	float foot = angle_of(sign * vec2(u.y, -u.x));
	uvec2 mask = beyond(foot, h);
	vec2 ends = sign > 0.0 ? vec2(low, high) : vec2(-high, -low);
	mask &= sector(foot + ends.x, foot + ends.y);
	mask = before ? mask : uvec2(0u);
	uvec2 twice = two ? mask : uvec2(0u);
	count(sum.seen, mask ^ twice, twice, sign > 0.0 ? ~0u : 0u);
	sum.any = sum.any || before;
}

// Whether an edge leads from its end v outside the disc farther away, so that none of it is before
// the disc.
bool leads_away(vec2 v, float before, vec2 along, float most)
{
	return before > 0.0 && dot(v, along) > 0.0 && dot(v, v) > most * before * before;
}

// Whether the edge may be before the disc.
bool may_hit(edge edge, eye eye)
{
	vec2 along = edge.before_a * edge.b - edge.before_b * edge.a;
	// Compilers make a branch of a call behind &&.
	bool away_a = leads_away(edge.a, edge.before_a, along, eye.most);
	bool away_b = leads_away(edge.b, edge.before_b, -along, eye.most);
	return max(edge.before_a, edge.before_b) > 0.0 &&
		edge.side * edge.side < eye.most * dot(along, along) && !away_a && !away_b;
}

#ifdef POINTS
// Whether the edge has a penumbra near the receiver, or between it and the next points, that does not
// show in them.
bool is_narrow(edge edge, eye eye)
{
	vec2 along = edge.b - edge.a;
	// Where the edge is nearest; of no length, at its end.
	float t = clamp(-dot(edge.a, along) / max(dot(along, along), 1e-30), 0.0, 1.0);
	vec2 nearest = edge.a + t * along;
	float width = eye.radius * mix(edge.before_a, edge.before_b, t);
	float reach = width + 0.75 * eye.spacing;
	return width > 0.0 && width < eye.spacing * WIDTH_SHOWN &&
		dot(nearest, nearest) < reach * reach;
}
#endif

// Origins are on the raster grid, as ends of edges are. One on an edge or at its end is where
// rasterisers have it, and edge_winding.h: a little to the right, and less upwards; of a step.
const vec2 BESIDE = vec2(1.0 / 256.0, 1.0 / 16384.0);

// The way from the origin to the receiver; coarse: steps of the grid that the sheets at its start are
// told by, which are those of the raster grid at a texel, and of edges as they are at a tile's centre.
struct way {
	vec2 path;
	float coarse;
};

way way_of(receiver r, origin from)
{
	float coarse = 1.0;
#ifdef COARSE
	coarse = from.depth > 1.0 ? 1.0 : raster_snap / snap;
#endif
	return way((r.s.xy - from.at) * (0.5 / snap) - coarse * BESIDE, coarse);
}

// How an edge lies to a way: cross products of the way and its ends, and the sheets that are gained
// where the way passes it.
struct crossing {
	float across_a, across_b;
	int turn;
};

crossing crossing_of(edge edge, eye eye, way way)
{
	vec2 a = edge.a, b = edge.b;
#ifdef COARSE
	a = floor((a + eye.at) / way.coarse + 0.5) * way.coarse - eye.at;
	b = floor((b + eye.at) / way.coarse + 0.5) * way.coarse - eye.at;
#endif
	float across_a = cross_of(way.path, a), across_b = cross_of(way.path, b);
	// But for rounding and BESIDE a whole number of squares of the grid, of which half a one is
	// far from any.
	float side = cross_of(a, b) - across_a + across_b;
	bool runs_down = dot(a - b, vec2(-BESIDE.y, BESIDE.x)) > 0.0;
	float least = (runs_down ? -0.5 : 0.5) * way.coarse * way.coarse;
	int turn = int(edge.side >= 0.0) - int(side >= least);
	return crossing(
		across_a, across_b, (across_a < 0.0) != (across_b < 0.0) ? turn : 0);
}

// Adds the sheets of an edge that the way passes.
void pass_edge(inout sums sum, edge edge, crossing at, int sheets, origin from)
{
	vec2 slope = from.slope * (DEPTH_STEPS * 2.0 * snap);
	vec2 before = from.depth * DEPTH_STEPS - vec2(edge.depth_a, edge.depth_b);
	// How far the crossing is before both, times `past`.
	float past = at.across_a - at.across_b;
	float rise = dot(slope, edge.b) * at.across_a - dot(slope, edge.a) * at.across_b;
	float lead = before.y * at.across_a - before.x * at.across_b;
	rise = past < 0.0 ? -rise : rise;
	lead = past < 0.0 ? -lead : lead;
	bool counts = lead + min(rise, 0.0) > 0.0;
	float behind = from.own_depth * DEPTH_STEPS * abs(past);
	bool own = !counts && lead + max(rise, 0.0) >= -behind;
	sum.winding += counts ? at.turn * sheets : 0;
	sum.own += own ? at.turn * sheets : 0;
}

// A tile's triangles over hollows, as texels of scene/edge_hollows.h: the edges of the first to the
// last one that counts, and a bit for each that does.
struct hollows {
	int start;      // of all
	int first, end; // those to walk along
	uint over;
};

// Those that the receiver is before the planes of, as deep as what they hide the disc from. That is
// one fetch for each: few tiles have any, and hardly a receiver is where one counts.
hollows hollows_over(receiver r, uvec4 tile, bool any)
{
	hollows found = hollows(0, 0, 0, 0u);
#ifdef HOLLOWS
	eye eye = eye_of(r);
	float rows = edge_rows(), depth = r.s.z * HOLLOW_DEPTHS;
	int count = any ? int(tile.y >> 17 & 127u) : 0;
	found.start = hollow_base + HOLLOW_TEXELS * int(tile.x >> 17);
	for (int i = 0; i < count;) {
		uvec4 plane = edge_at(found.start + 3 * count + i, rows);
		float least = dot(uintBitsToFloat(plane.xy), eye.at) + uintBitsToFloat(plane.z);
		float near = float(plane.w & 0xffffu), far = float(plane.w >> 16);
		bool counts = least > eye.depth && depth > near && depth < far;
		int edges = found.start + 3 * i;
		found.first = counts && found.over == 0u ? edges : found.first;
		found.end = counts ? edges + 3 : found.end;
		found.over |= counts ? 1u << i : 0u;
		i++;
		if (i >= count)
			break;
	}
#endif
	return found;
}

// Whether an edge is of none of these, or of one that counts.
bool is_over(hollows hollows, int i)
{
#ifdef HOLLOWS
	// A third, of less than 96.
	int triangle = max(i - hollows.start, 0) * 171 >> 9;
	return i < hollows.start || (hollows.over >> (triangle & 31) & 1u) != 0u;
#else
	return true;
#endif
}

// Walks along edges. One between the origin and the receiver is where a sheet starts or ends. In whole
// lists, which are in the order of their nearest ends, leaves them where the rest plays no part.
void walk_edges(inout sums sum, receiver r, origin from, int first, int end, hollows hollows)
{
	float rows = edge_rows(), deepest = from.deepest * DEPTH_STEPS;
	eye eye = eye_of(r);
	way way = way_of(r, from);
	int i = first;
#if defined(HOLLOWS) && !defined(RUNS)
	bool last = i >= end;
	i = last ? hollows.first : i;
	end = last ? hollows.end : end;
	deepest = last ? DEPTH_STEPS : deepest;
#endif
	while (i < end) {
		bool plays = false;
		uvec4 texel = uvec4(0u);
		// To the next edge that may be before the disc: where some lanes of a processor
		// still look for theirs the others wait here, not at each edge. What is known of it
		// is found again below: that costs less than to keep it apart for each lane.
		while (i < end) {
			texel = edge_at(i, rows);
			edge next = edge_of(texel, eye);
#ifndef RUNS
			end = min(next.depth_a, next.depth_b) < deepest ? end : i;
#endif
			bool passed = crossing_of(next, eye, way).turn != 0;
			bool hit = may_hit(next, eye);
			plays = passed || hit;
#ifdef POINTS
			bool narrow = is_narrow(next, eye);
			narrow_penumbra = narrow_penumbra || narrow;
#endif
			i++;
			if (i >= end || plays)
				break;
		}
		edge edge = edge_of(texel, eye);
		bool two = (texel.w & 1u) != 0u, hit = may_hit(edge, eye) && is_over(hollows, i - 1);
		// Ways do not count a grazing triangle's.
		int sheets = two ? 2 : 1 - int(texel.y & 1u);
		if (plays)
			pass_edge(sum, edge, crossing_of(edge, eye, way), sheets, from);
		if (plays && hit)
			add_edge(sum, edge, two, r, eye);
#if defined(HOLLOWS) && !defined(RUNS)
		bool next = !last && i >= end;
		i = next ? hollows.first : i;
		end = next ? hollows.end : end;
		deepest = next ? DEPTH_STEPS : deepest;
		last = last || next;
#endif
		if (i >= end)
			break;
	}
}

#ifdef RUNS
// Widens boxes, in steps, for what floats round.
const float BOX_SLACK = 0.25;

// How far around the receiver, in steps of boxes, the way from the origin or the disc's rim may lie:
// with |E v| >= shrink |v|, what is before the disc by s <= d + |tilt| |v| is not farther away than
// per_depth d + margin.
struct reach {
	vec2 at;
	float per_depth, margin, least;
};

reach reach_of(receiver r, origin from)
{
	float share = r.shrink - disc_scale * length(r.tilt);
	float least = length(r.s.xy - from.at) * BOX_STEPS, margin = 0.0;
#ifdef COARSE
	least += 2.0 * raster_snap * BOX_STEPS;
#endif
#ifdef POINTS
	margin = 0.75 * r.spacing * BOX_STEPS / max(share, 1e-6);
#endif
	// So near to a spot everything is before the disc.
	bool all = share < 1e-3;
	return reach(r.s.xy * BOX_STEPS, all ? 0.0 : disc_scale * BOX_STEPS / share,
		margin + BOX_SLACK, all ? 2.0 * BOX_STEPS : least + BOX_SLACK);
}

sums walk(receiver r, origin from, int first, int end, hollows hollows)
{
	sums sum = no_sums();
	reach reach = reach_of(r, from);
	float rows = run_rows();
	bool last = hollows.first >= hollows.end;
	for (int run = first; run < end || !last;) {
		int begin = 0, stop = 0;
		while (run < end) {
			uvec4 found = run_at(run, rows);
			float start = uintBitsToFloat(found.y);
			vec2 low = vec2(ivec2(found.zz >> BOX_SHIFT & 0xffffu));
			vec2 high = vec2(ivec2(found.ww >> BOX_SHIFT & 0xffffu)) + 1.0;
			vec2 off = max(max(low - reach.at, reach.at - high), 0.0);
			float within = (r.s.z - start) * reach.per_depth + reach.margin;
			within = max(within, reach.least);
			end = from.deepest > start ? end : run;
			bool near = from.deepest > start && dot(off, off) <= within * within;
			begin = int(found.x & 0xffffffu);
			stop = near ? begin + int(found.x >> 24) : begin;
			run++;
			if (run >= end || stop != begin)
				break;
		}
		// What is found last is behind all runs.
		bool none = stop == begin;
		begin = none && !last ? hollows.first : begin;
		stop = none && !last ? hollows.end : stop;
		last = last || none;
		walk_edges(sum, r, from, begin, stop, hollows);
		if (run >= end && last)
			break;
	}
	return sum;
}
#else
sums walk(receiver r, origin from, int first, int end, hollows hollows)
{
	sums sum = no_sums();
	walk_edges(sum, r, from, first, end, hollows);
	return sum;
}
#endif

float gathered_visibility(receiver r)
{
#ifdef POINTS
	// Farther apart, points may miss edges in tiles between theirs, which lists reach beyond.
	narrow_penumbra = r.spacing * tile_count > 2.0;
#endif
	vec2 at = floor(r.s.xy * tile_count);
	bool inside = all(equal(at, clamp(at, vec2(0.0), vec2(tile_count - 1.0))));
	vec2 tile_at = inside ? at : vec2(0.0);
	uvec4 tile = textureLod(edge_tiles, (tile_at + 0.5) / tile_count, 0.0);
	origin from = origin_of(r, tile, tile_at);
	int first = int(tile.x & 0x1ffffu), edges = int(tile.y & 0x1ffffu);
	bool any_before = inside && light_arrives && from.deepest > uintBitsToFloat(tile.z);
	bool among = inside && light_arrives && r.s.z <= uintBitsToFloat(tile.w);
	hollows hollows = hollows_over(r, tile, among);
	sums sum = walk(r, from, first, any_before ? first + edges : first, hollows);
	if (!inside)
		return 1.0;
	sum.winding = max(sum.winding + (sum.own > 0 ? from.seen : from.winding), 0);
	float covered = float(sum.winding) - sum.behind / TURN;
	// Only edges leave a part of the disc.
	if (sum.any && sum.winding <= WINDING_MAX) {
		for (int i = 0; i < sum.winding; i++)
			count(sum.seen, uvec2(~0u), uvec2(0u), 0u);
		covered = covered_share(sum.seen, covered);
	}
	return 1.0 - clamp(covered, 0.0, 1.0);
}

#ifndef RECEIVERS
float gathered_visibility(vec3 p)
{
	vec3 s = on_screen(p);
	float spacing = max(length(dFdx(s.xy)), length(dFdy(s.xy)));
	return gathered_visibility(receiver_of(s, receiver_slope(s), casts, spacing));
}

#ifndef CELLS
float shadow_visibility(vec3 p)
{
	return gathered_visibility(p);
}
#endif
#endif
