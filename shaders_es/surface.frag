in vec3 surface_position; // light space
in vec3 surface_normal;
in float surface_up;
#ifdef TEXTURED
in vec2 surface_uv;
uniform sampler2D base_texture;
#endif

#ifdef POINTS
layout(location = 0) out uvec2 point; // see sparse_cells.frag
#elif defined(RECEIVERS)
// Window coordinates on the light's screen, as bits of floats; the slope of the receiver's plane, as
// sheets have theirs in the layers; in its lowest bits, whether the receiver casts as well, and whether
// it faces away from the light.
layout(location = 0) out uvec4 receiver;
#else
layout(location = 0) out vec4 color;
#endif

// Squares of lengths below this (in scene units) count as this, so that no quotient is infinite:
// the smallest normal float is 1.2e-38.
const float TINY = 1e-36;

#ifdef LIT
vec3 path_to_light()
{
	return light_is_point ? -surface_position : vec3(0.0, 0.0, -1.0);
}
#endif

#ifdef SHADOWED
// On the surface's own plane.
vec3 seen_position()
{
	vec3 p = surface_position;
#ifdef COARSE
	vec2 pixels = to_middle();
	p += pixels.x * dFdx(p) + pixels.y * dFdy(p);
#endif
	return p;
}
#endif

#if defined(VISIBILITY) && defined(LIT)
// The triangle's own normal, since visibility is that of the geometry, not of how it is shaded; on
// the side that is seen, as the interpolated one tells.
bool faces_light()
{
	vec3 n = cross(dFdx(surface_position), dFdy(surface_position));
	bool outward = (dot(n, surface_normal) > 0.0) == gl_FrontFacing;
	return outward ? dot(n, path_to_light()) > 0.0 : dot(n, path_to_light()) < 0.0;
}
#elif defined(LIT)
// Cosine between the normal, on the side that is seen, and the way to the light, times |path|.
float facing(vec3 path)
{
	float toward = dot(surface_normal, path);
	return gl_FrontFacing ? toward : -toward;
}

float strength()
{
	vec3 path = path_to_light();
	float inverse = inversesqrt(max(dot(path, path), TINY));
	// The normals at the vertices are of length 1, so that the first term of 1 / sqrt(x) around 1
	// is enough to bring one between them back to it.
	float inverse_normal = 1.5 - 0.5 * dot(surface_normal, surface_normal);
	// From a thousandth of the target's distance on, light grows no more.
	float near = min(light_reach * inverse * inverse, 1e6);
	float cone = clamp(-path.z * inverse * light_cone.x + light_cone.y, 0.0, 1.0);
	cone = cone * cone * (3.0 - 2.0 * cone);
	return max(facing(path), 0.0) * (inverse * inverse_normal) * (near * cone);
}
#endif

#ifdef POINTS
void main()
{
	float v = 1.0;
	bool wide = true;
#ifdef SHADOWED
	v = clamp(shadow_visibility(seen_position()), 0.0, 1.0);
	wide = !narrow_penumbra;
#endif
	point = uvec2(floatBitsToUint(gl_FragCoord.z),
		uint(v * 65535.0 + 0.5) | (wide ? 0x10000u : 0u));
}
#elif defined(RECEIVERS)
void main()
{
	// Beside the screen all is lit.
	receiver = uvec4(floatBitsToUint(2.0), 0u, 0u, 0u);
#ifdef SHADOWED
#ifdef VISIBILITY
	bool arrives = faces_light();
#else
	bool arrives = strength() > 0.0;
#endif
	vec3 s = on_screen(seen_position());
	// Half floats end at 65504.
	vec2 steps = clamp(receiver_slope(s) * (SLOPE_SCALE * map_size.y), -6e4, 6e4);
	uint slope = packHalf2x16(steps);
	uint bits = (casts ? 1u : 0u) | (arrives ? 0u : 0x10000u);
	receiver = uvec4(floatBitsToUint(s), slope & ~0x10001u | bits);
#endif
}
#elif defined(VISIBILITY)
void main()
{
	float v = 1.0;
#ifdef LIT
	bool faces = faces_light();
#ifdef SHADOWED
	light_arrives = faces;
	v = clamp(shadow_visibility(seen_position()), 0.0, 1.0);
#endif
	v = faces ? v : 0.0;
#endif
	float steps = floor(v * 65535.0 + 0.5);
	float high = floor(steps / 256.0);
	color = vec4(high, steps - 256.0 * high, 0.0, 255.0) / 255.0;
}
#else
void main()
{
	float n_up = gl_FrontFacing ? surface_up : -surface_up;
	vec3 received = mix(ambient_ground, ambient_sky, 0.5 + 0.5 * n_up);
#ifdef SHADOWED
	float unshadowed = strength();
	light_arrives = unshadowed > 0.0;
	// The same as below to the bit where all is seen, also where products and sums are fused.
	received += light_color * (unshadowed * shadow_visibility(seen_position()));
#elif defined(LIT)
	received += light_color * strength();
#endif
	vec3 c = base_color * received;
#ifdef TEXTURED
	c *= texture(base_texture, surface_uv).rgb;
#endif
#ifdef ENCODE_SRGB
	c = encode_srgb(c);
#endif
	color = vec4(c, 1.0);
}
#endif
