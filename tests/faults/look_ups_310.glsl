// Beside those of OpenGL ES 3.0. The component that is gathered is a constant.
vec4 off_gather(highp sampler2D s, vec2 p, int c)
{
	p.x += OFF_TEXEL;
	return c == 0 ? textureGather(s, p, 0) : c == 1 ? textureGather(s, p, 1)
		: c == 2 ? textureGather(s, p, 2) : textureGather(s, p, 3);
}

vec4 off_gather(highp sampler2D s, vec2 p)
{
	return off_gather(s, p, 0);
}

vec4 off_gather(highp sampler2DShadow s, vec2 p, float d)
{
	p.x += OFF_TEXEL;
	return textureGather(s, p, d);
}

#define textureGather off_gather
