in vec3 position;

uniform mat4 object_to_clip;

void main()
{
	gl_Position = object_to_clip * vec4(position, 1.0);
}
