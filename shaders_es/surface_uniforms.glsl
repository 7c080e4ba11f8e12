// What a surface is, and the light that it is in.
uniform vec3 base_color;
uniform vec3 ambient_sky;
uniform vec3 ambient_ground;
#ifdef LIT
uniform bool light_is_point; // a spot; else directional
uniform vec3 light_color;    // illuminance at the target
uniform float light_reach;   // spot: squared distance of the target; else 1
uniform vec2 light_cone;     // share inside = x cosine to the axis + y, clamped; always 1: (0, 1)
#endif
