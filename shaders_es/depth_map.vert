in vec3 position;

uniform mat4 object_to_clip;

#ifdef COARSE
out vec3 clip_place; // see common_middle.glsl
#endif

void main()
{
	gl_Position = object_to_clip * vec4(position, 1.0);
#ifdef COARSE
	clip_place = gl_Position.xyw;
#endif
}
