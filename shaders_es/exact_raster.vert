// The rectangle that a primitive is in, four vertices each: all that is left to the rasteriser. Its
// sides lie between pixel centres, far from any rounding.
uniform isampler2D primitives; // PRIMITIVE_TEXELS each, ROW_PRIMITIVES in a row
uniform vec2 pixel_size;       // of the target, NDC

flat out ivec4 primitive[PRIMITIVE_TEXELS - 1]; // behind the rectangle

const int ROW_PRIMITIVES = 128;

void main()
{
	int index = gl_VertexID / 4, corner = gl_VertexID % 4;
	ivec2 texel = ivec2(index % ROW_PRIMITIVES * PRIMITIVE_TEXELS, index / ROW_PRIMITIVES);
	ivec4 rect = texelFetch(primitives, texel, 0);
	for (int i = 1; i < PRIMITIVE_TEXELS; i++)
		primitive[i - 1] = texelFetch(primitives, texel + ivec2(i, 0), 0);
	ivec2 at = ivec2(corner == 1 || corner == 2 ? rect.z : rect.x, corner < 2 ? rect.y : rect.w);
	gl_Position = vec4(vec2(at) * pixel_size - 1.0, 0.0, 1.0);
}
