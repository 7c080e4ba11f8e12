// The visibility of pixels that is known without looking at edges. Leaves the others to
// deferred_find.frag. See src/deferred_pass.h.
uniform usampler2D edge_tiles; // struct edge_tile of scene/edge_grid.h

layout(location = 0) out uint found; // steps of 1/65535

// Beside the light's screen, or behind all casters of a tile without edges.
bool is_plain(vec3 s, out float v)
{
	vec2 at = floor(s.xy * tile_count);
	bool inside = all(equal(at, clamp(at, vec2(0.0), vec2(tile_count - 1.0))));
	uvec4 tile = textureLod(edge_tiles, (inside ? at + 0.5 : vec2(0.5)) / tile_count, 0.0);
	bool edges = uintBitsToFloat(tile.z) < 2.0;
	bool behind = s.z > uintBitsToFloat(tile.w);
	v = inside && int(tile.y >> 24) > 128 ? 0.0 : 1.0;
	return !inside || (!edges && behind);
}

void main()
{
	uvec4 texel = receiver_at(gl_FragCoord.xy);
	float v;
	bool known = is_plain(uintBitsToFloat(texel.xyz), v);
#ifdef CELLS
	float between;
	vec2 at = floor(gl_FragCoord.xy) / POINT_SPACING + 1.0;
	bool on_cell = is_of_cell(at, depth_at(gl_FragCoord.xy), between);
	v = known ? v : between;
	known = known || on_cell;
#endif
	bool dark = !receives(texel);
	if (!known && !dark)
		discard;
	found = dark ? 0u : steps_of(v);
}
