in vec3 position;
in vec3 normal;
#ifdef TEXTURED
in vec2 uv;
#endif

// Light space: the light's own axes, x right and y up on its screen, z away from it.
uniform mat4 object_to_clip;
uniform mat4 object_to_light;
uniform mat3 normal_to_light;
uniform vec3 up; // of the world, in light space

out vec3 surface_position; // light space
out vec3 surface_normal;   // likewise
out float surface_up;      // y of the normal in the world
#ifdef TEXTURED
out vec2 surface_uv;
#endif
#if defined(SEEN) || defined(SAMPLES)
out vec2 surface_depth; // z and w of clip space
#endif
#ifdef COARSE
out vec3 clip_place; // see common_middle.glsl
#endif

// The lights after the first are added where the depth is equal.
invariant gl_Position;

void main()
{
	gl_Position = object_to_clip * vec4(position, 1.0);
	surface_position = (object_to_light * vec4(position, 1.0)).xyz;
	vec3 n = normal_to_light * normal;
	// A flattened object has normals of no length.
	surface_normal = n * inversesqrt(max(dot(n, n), 1e-30));
	surface_up = dot(surface_normal, up);
#ifdef TEXTURED
	surface_uv = uv;
#endif
#if defined(SEEN) || defined(SAMPLES)
	surface_depth = gl_Position.zw;
#endif
#ifdef COARSE
	clip_place = gl_Position.xyw;
#endif
#if defined(HANDS_ON_EDGES)
	hand_on_edges();
#elif defined(HANDS_ON_SCREEN)
	hand_on_screen(vec2(lookup_reach, near_to_far));
#endif
#ifdef HANDS_ON_SURFACE
	hand_on_surface();
#endif
}
