in vec3 position; // normalised device coordinates
in vec2 offset;   // from the silhouette, likewise
in float width;   // of the fin here, likewise

out vec2 fin_offset;
out float fin_width;

void main()
{
	gl_Position = vec4(position, 1.0);
	fin_offset = offset;
	fin_width = width;
}
