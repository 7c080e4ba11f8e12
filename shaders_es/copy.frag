uniform sampler2D base_texture; // decoded to linear light when read

layout(location = 0) out vec4 color;

void main()
{
	color = vec4(encode_srgb(texelFetch(base_texture, ivec2(gl_FragCoord.xy), 0).rgb), 1.0);
}
