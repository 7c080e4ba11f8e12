// Of struct fixed_fin (src/fixed/primitive.h).
const int PRIMITIVE_TEXELS = 7;
