// Of struct fixed_receiver (src/fixed/primitive.h).
const int PRIMITIVE_TEXELS = 9;
