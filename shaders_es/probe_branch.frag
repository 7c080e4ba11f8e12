// Work beside a branch that passes over it, for a probe of what that costs.
uniform vec4 probe_value; // x: blocks of 8 x 8 pixels that work: 0 none, 1 every other, 2 all

layout(location = 0) out vec4 value;

// Straight on: a loop is left by drivers that pass over nothing else.
#define STEP v = fract(v * 1.37 + v.yzwx);
#define STEPS_4 STEP STEP STEP STEP
#define STEPS_16 STEPS_4 STEPS_4 STEPS_4 STEPS_4

void main()
{
	ivec2 block = ivec2(gl_FragCoord.xy) >> 3;
	vec4 v = fract(gl_FragCoord.xyxy * vec4(0.17, 0.31, 0.47, 0.61));
	if (float((block.x + block.y) & 1) < probe_value.x - 0.5) {
		STEPS_16 STEPS_16 STEPS_16 STEPS_16
	}
	value = v;
}
