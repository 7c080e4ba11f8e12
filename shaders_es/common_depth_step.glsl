// Sixteen steps of a 24-bit depth map: rounding of two depths that are compared, and of their
// interpolation, for which SwiftShader takes up to eleven.
const float DEPTH_STEP = 16.0 / 16777216.0;
