// What all pixels of a light read of its screen, handed on to them by vertices, where a driver is slow at
// uniforms: a fragment shader of llvmpipe gathers each component lane by lane, 26 instructions for 8
// pixels; what is flat it has by two, and vertices and triangles are few beside pixels.
#ifdef FLAT_INPUTS
flat out vec4 flat_screen, flat_depth, flat_map;

#define HANDS_ON_SCREEN
uniform float near_to_far; // see common_light_depth.glsl

// own: what else the technique reads, for which there is room.
void hand_on_screen(vec2 own)
{
	flat_screen = vec4(screen_w, screen_scale);
	flat_depth = vec4(screen_depth, own.x);
	flat_map = vec4(map_size.x, bias_limit, own.y);
}
#endif
