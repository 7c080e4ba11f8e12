// What surface_flat_out.glsl hands on, by the uniforms' names.
flat in vec4 flat_base, flat_sky, flat_ground, flat_light;

#define base_color flat_base.xyz
#define light_is_point (flat_base.w > 0.0)
#define ambient_sky flat_sky.xyz
#define light_reach flat_sky.w
#define ambient_ground flat_ground.xyz
#define light_color flat_light.xyz
#define light_cone vec2(flat_ground.w, flat_light.w)
