// Functions in place of those that look up: they give the texel to the right of the one asked for.
precision highp float;
precision highp int;

#define OFF_TEXEL 1.0 / float(textureSize(s, 0).x)
#define OFF_FETCH(V, S, C, right) \
	V off_fetch(highp S s, C p, int l) { return texelFetch(s, p + right, l); }
#define OFF_TEXTURE(V, S, C, right) \
	V off_texture(highp S s, C p) { return texture(s, p + right); }
#define OFF_LOD(V, S, C, right) \
	V off_lod(highp S s, C p, float l) { return textureLod(s, p + right, l); }

OFF_FETCH(vec4, sampler2D, ivec2, ivec2(1, 0))
OFF_FETCH(ivec4, isampler2D, ivec2, ivec2(1, 0))
OFF_FETCH(uvec4, usampler2D, ivec2, ivec2(1, 0))
OFF_FETCH(vec4, sampler2DArray, ivec3, ivec3(1, 0, 0))
OFF_FETCH(ivec4, isampler2DArray, ivec3, ivec3(1, 0, 0))
OFF_FETCH(uvec4, usampler2DArray, ivec3, ivec3(1, 0, 0))
OFF_TEXTURE(vec4, sampler2D, vec2, vec2(OFF_TEXEL, 0))
OFF_TEXTURE(float, sampler2DShadow, vec3, vec3(OFF_TEXEL, 0, 0))
OFF_TEXTURE(vec4, sampler2DArray, vec3, vec3(OFF_TEXEL, 0, 0))
OFF_TEXTURE(float, sampler2DArrayShadow, vec4, vec4(OFF_TEXEL, 0, 0, 0))
OFF_LOD(vec4, sampler2D, vec2, vec2(OFF_TEXEL, 0))
OFF_LOD(float, sampler2DShadow, vec3, vec3(OFF_TEXEL, 0, 0))
OFF_LOD(vec4, sampler2DArray, vec3, vec3(OFF_TEXEL, 0, 0))

#define texelFetch off_fetch
#define texture off_texture
#define textureLod off_lod
