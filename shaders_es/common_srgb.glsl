// Linear light to sRGB (IEC 61966-2-1), for framebuffers that do not encode. Above its straight
// foot the curve 1.055 c^(1/2.4) - 0.055 is fitted by roots, which cost a third of a power: the
// greatest error is 0.092 steps of 1/255.
vec3 encode_srgb(vec3 c)
{
	c = clamp(c, 0.0, 1.0);
	vec3 root = sqrt(c);
	vec3 curve = 0.83375853 * root + 0.29810227 * sqrt(root) - 0.05531764 * c - 0.07690207;
	return mix(12.92 * c, curve, step(0.0031308, c));
}
