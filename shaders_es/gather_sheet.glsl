// Slopes of sheets, depth over a texel, are kept as half floats of so many times themselves: the
// least of them without loss is 6e-5.
const float SLOPE_SCALE = 1024.0;
