// The words of a shadow map without fins; see smoothie_word.glsl.
uniform sampler2D base_texture; // the map

layout(location = 0) out ivec4 word;

void main()
{
	float depth = texelFetch(base_texture, ivec2(gl_FragCoord.xy), 0).r;
	word = ivec4(floatBitsToInt(depth));
}
