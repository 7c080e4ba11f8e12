// The light's screen, and the maps on it.
uniform vec2 map_size;      // texels, and the size of one
uniform vec2 bias_limit;    // at window depth d: x + y d
uniform vec3 screen_w;      // w of light space: x z + y, at least z
uniform float screen_scale; // window x, y = scale x, y / w + 1/2
uniform vec3 screen_depth;  // window depth = x + y / w + z z
uniform float lookup_reach; // how far from a surface its texels' centres lie, window x or y
