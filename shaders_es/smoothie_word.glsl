// A texel of a shadow map and of the smoothies before it, in one word: the bits of the map's depth
// where no fin is; else below 0, and from the top the nearest fin's depth and that of the map, linear,
// and the root of the least alpha', so that steps of it are as fine as dark is to the eye.
const int FIN_WORD = 1 << 31;
const int FIN_BITS = 11, MAP_BITS = 12, ALPHA_BITS = 8;
const int FIN_SHIFT = MAP_BITS + ALPHA_BITS;
const int FIN_MASK = (1 << FIN_BITS) - 1;
const int MAP_MASK = ((1 << MAP_BITS) - 1) << ALPHA_BITS;
const int ALPHA_MASK = (1 << ALPHA_BITS) - 1;
const float FIN_STEPS = float(FIN_MASK);
const float MAP_STEPS = float((1 << MAP_BITS) - 1);
const float ALPHA_STEPS = float(1 << ALPHA_BITS); // alpha' is below 1
