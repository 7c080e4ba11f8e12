// As gather_flat_out.glsl has what a technique reads, what surfaces read.
flat out vec4 flat_base, flat_sky, flat_ground, flat_light;

#define HANDS_ON_SURFACE
void hand_on_surface()
{
#ifdef LIT
	flat_base = vec4(base_color, light_is_point);
	flat_sky = vec4(ambient_sky, light_reach);
	flat_ground = vec4(ambient_ground, light_cone.x);
	flat_light = vec4(light_color, light_cone.y);
#endif
}
