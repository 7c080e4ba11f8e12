// As screen_flat_out.glsl has the screen, what surfaces read.
flat out vec4 flat_base, flat_sky, flat_ground, flat_light;

#define HANDS_ON_SURFACE
void hand_on_surface()
{
	flat_base.xyz = base_color;
	flat_sky.xyz = ambient_sky;
	flat_ground.xyz = ambient_ground;
#ifdef LIT
	flat_base.w = float(light_is_point);
	flat_sky.w = light_reach;
	flat_ground.w = light_cone.x;
	flat_light = vec4(light_color, light_cone.y);
#endif
}
