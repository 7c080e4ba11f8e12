// Of struct fixed_blocker (src/fixed/primitive.h).
const int PRIMITIVE_TEXELS = 5;
