/* SPDX-License-Identifier: MIT */
/* Triangles: where they are clipped, which pixels they cover, and what of their corners reaches
 * those. */
#include "check/gl_cases.h"
#include "check/gl_kit.h"
#include <math.h>
#include <stdio.h>

struct drawing {
	const char *name;
	/* Body of a function that sets gl_Position and `value` from the vertex's number `n`. */
	const char *vertex;
	const char *expression; /* float that is drawn; NULL: 1 */
	GLsizei vertices;
	void (*set_up)(void);
	/* What a pixel must hold, at its centre in NDC; cleared ones hold 0; NAN: anything. */
	double (*truth)(double x, double y);
	double tolerance;
	bool flat;
};

/* Corners of one triangle that covers the screen, and six of a rectangle. */
#define SCREEN "	vec2 c = vec2(n & 1, n >> 1) * 4.0 - 1.0;\n"
#define RECTANGLE                                                   \
	"	int k = n % 6;\n"                                         \
	"	vec2 c = vec2(k == 1 || k == 2 || k == 4 ? 1.0 : -1.0,\n" \
	"		k == 2 || k == 4 || k == 5 ? 1.0 : -1.0);\n"

static double everywhere(double x, double y)
{
	(void)x;
	(void)y;
	return 1;
}

static double nowhere(double x, double y)
{
	(void)x;
	(void)y;
	return 0;
}

static double right_half(double x, double y)
{
	(void)y;
	return x > 0;
}

static double left_half(double x, double y)
{
	(void)y;
	return x < 0;
}

static double middle(double x, double y)
{
	(void)y;
	return fabs(x) < .5;
}

static double inner_square(double x, double y)
{
	return fabs(x) < .5 && fabs(y) < .5;
}

static double scissored(double x, double y)
{
	double column = (x + 1) * 32, row = (y + 1) * 32;
	return column > 5 && column < 25 && row > 7 && row < 37;
}

/* A floor one below the eye ends at a distance of 10. */
static double floor_below(double x, double y)
{
	(void)x;
	return y < -.1;
}

static double floor_distance(double x, double y)
{
	(void)x;
	return y < -.1 ? -1 / y / 10 : 0;
}

static double slope(double x, double y)
{
	return .5 + x * .25 + y * .125;
}

static double last_vertex(double x, double y)
{
	/* The second triangle of the rectangle is above the rising diagonal. */
	return x == y ? NAN : y > x ? .75 : .25;
}

static double checkered(double x, double y)
{
	int column = (int)((x + 1) * 32), row = (int)((y + 1) * 32);
	return (column + row) % 2 == 0;
}

static double column_of(double x, double y)
{
	(void)y;
	return (x + 1) / 2;
}

static double row_of(double x, double y)
{
	(void)x;
	return (y + 1) / 2;
}

static double one_fifth(double x, double y)
{
	(void)x;
	(void)y;
	return .2;
}

/* The centre's own pixels have as many slivers as the grid of subpixels lets them. */
static double one_fifth_but_centre(double x, double y)
{
	return fabs(x) < .05 && fabs(y) < .05 ? NAN : .2;
}

static double below_left(double x, double y)
{
	double sum = x + y;
	return fabs(sum) < .01 ? NAN : sum < 0;
}

static void set_viewport(void)
{
	glViewport(16, 16, 32, 32);
}

static void set_scissor(void)
{
	glEnable(GL_SCISSOR_TEST);
	glScissor(5, 7, 20, 30);
}

static void count_up(void)
{
	glEnable(GL_BLEND);
	glBlendEquation(GL_FUNC_ADD);
	glBlendFunc(GL_ONE, GL_ONE);
}

static void cull_back(void)
{
	glEnable(GL_CULL_FACE);
	glCullFace(GL_BACK);
}

static void cull_front(void)
{
	glEnable(GL_CULL_FACE);
	glCullFace(GL_FRONT);
}

static void cull_clockwise_front(void)
{
	cull_back();
	glFrontFace(GL_CW);
}

/* Of bytes, half a step. */
#define BYTE (.5 / 255 + 1e-6)

static const struct drawing drawings[] = {
	{"clip.none", SCREEN "	gl_Position = vec4(c, 0.0, 1.0);\n", NULL, 3, NULL, everywhere, 0,
		false},
	{"clip.near", RECTANGLE "	gl_Position = vec4(c, c.x - 1.0, 1.0);\n", NULL, 6, NULL,
		right_half, 0, false},
	{"clip.far", RECTANGLE "	gl_Position = vec4(c, c.x + 1.0, 1.0);\n", NULL, 6, NULL,
		left_half, 0, false},
	{"clip.near-and-far", RECTANGLE "	gl_Position = vec4(c, c.x * 2.0, 1.0);\n", NULL, 6,
		NULL, middle, 0, false},
	{"clip.beyond-far", RECTANGLE "	gl_Position = vec4(c, 1.5, 1.0);\n", NULL, 6, NULL, nowhere,
		0, false},
	{"clip.before-near", RECTANGLE "	gl_Position = vec4(c, -1.5, 1.0);\n", NULL, 6, NULL,
		nowhere, 0, false},
	{"clip.sides", RECTANGLE "	gl_Position = vec4(c * 5.0, 0.0, 1.0);\n", NULL, 6, NULL,
		everywhere, 0, false},
	{"clip.huge", RECTANGLE "	gl_Position = vec4(c * 1e6, 0.0, 1.0);\n", NULL, 6, NULL,
		everywhere, 0, false},
	{"clip.one-side", RECTANGLE "	gl_Position = vec4(c + vec2(1.0, 0.0), 0.0, 1.0);\n", NULL,
		6, NULL, right_half, 0, false},
	{"clip.behind",
		RECTANGLE "	float d = c.y * 10.0;\n"
			  "	gl_Position = vec4(c.x * 100.0, -1.0, d - 1.0, d);\n",
		NULL, 6, NULL, floor_below, 0, false},
	{"clip.behind-all", SCREEN "	gl_Position = vec4(-c, 0.0, -1.0);\n", NULL, 3, NULL,
		nowhere, 0, false},
	{"clip.viewport", SCREEN "	gl_Position = vec4(c, 0.0, 1.0);\n", NULL, 3, set_viewport,
		inner_square, 0, false},
	{"clip.scissor", SCREEN "	gl_Position = vec4(c, 0.0, 1.0);\n", NULL, 3, set_scissor,
		scissored, 0, false},
	{"clip.values",
		RECTANGLE "	gl_Position = vec4(c * 3.0, 0.0, 1.0);\n"
			  "	value = 0.5 + c.x * 0.75 + c.y * 0.375;\n",
		"value", 6, NULL, slope, BYTE, false},

	{"raster.grid",
		"	int cell = n / 6;\n" RECTANGLE
		"	ivec2 at = ivec2(cell & 7, cell >> 3) + ivec2(c * 0.5 + 0.5);\n"
		"	bool inner = at.x > 0 && at.x < 8 && at.y > 0 && at.y < 8;\n"
		"	ivec2 moved = ivec2(at.x * 7 + at.y * 5, at.x * 3 + at.y * 11) % 9 - 4;\n"
		"	vec2 corner = vec2(at) + (inner ? vec2(moved) * 0.07 : vec2(0));\n"
		"	gl_Position = vec4(corner / 4.0 - 1.0, 0.0, 1.0);\n",
		"0.2", 384, count_up, one_fifth, 0, false},
	{"raster.fan",
		"	float turn = float(n / 3 + n % 3 - 1) * 6.28318530718 / 61.0;\n"
		"	bool last = n / 3 == 60 && n % 3 == 2;\n"
		"	vec2 c = last ? vec2(1.0, 0.0) : vec2(cos(turn), sin(turn));\n"
		"	if (n / 3 == 0 && n % 3 == 1)\n"
		"		c = vec2(1.0, 0.0);\n"
		"	gl_Position = vec4(n % 3 == 0 ? vec2(0) : c * 3.0, 0.0, 1.0);\n",
		"0.2", 183, count_up, one_fifth_but_centre, 0, false},
	{"raster.diagonal",
		"	vec2 c = vec2(n & 1, n >> 1) * 2.0 - 1.0;\n"
		"	gl_Position = vec4(c, 0.0, 1.0);\n",
		NULL, 3, NULL, below_left, 0, false},
	{"raster.no-area", SCREEN "	gl_Position = vec4(c.x, c.x, 0.0, 1.0);\n", NULL, 3, NULL,
		nowhere, 0, false},
	{"raster.cull-back", SCREEN "	gl_Position = vec4(c, 0.0, 1.0);\n", NULL, 3, cull_back,
		everywhere, 0, false},
	{"raster.cull-front", SCREEN "	gl_Position = vec4(c, 0.0, 1.0);\n", NULL, 3, cull_front,
		nowhere, 0, false},
	{"raster.front-face", SCREEN "	gl_Position = vec4(c, 0.0, 1.0);\n", NULL, 3,
		cull_clockwise_front, nowhere, 0, false},
	{"raster.facing", SCREEN "	gl_Position = vec4(c, 0.0, 1.0);\n",
		"gl_FrontFacing ? 1.0 : 0.5", 3, NULL, everywhere, 0, false},
	{"raster.column", SCREEN "	gl_Position = vec4(c, 0.0, 1.0);\n",
		"gl_FragCoord.x / 64.0", 3, NULL, column_of, BYTE, false},
	{"raster.row", SCREEN "	gl_Position = vec4(c, 0.0, 1.0);\n", "gl_FragCoord.y / 64.0", 3,
		NULL, row_of, BYTE, false},
	{"raster.discard", SCREEN "	gl_Position = vec4(c, 0.0, 1.0);\n",
		"drop((int(gl_FragCoord.x) + int(gl_FragCoord.y)) % 2 != 0)", 3, NULL, checkered, 0,
		false},

	{"varying.linear",
		SCREEN "	gl_Position = vec4(c, 0.0, 1.0);\n"
		       "	value = 0.5 + c.x * 0.25 + c.y * 0.125;\n",
		"value", 3, NULL, slope, BYTE, false},
	{"varying.perspective",
		RECTANGLE "	float d = c.y * 10.0;\n"
			  "	gl_Position = vec4(c.x * 100.0, -1.0, d - 1.0, d);\n"
			  "	value = d / 10.0;\n",
		"value", 6, NULL, floor_distance, BYTE, false},
	/* The near corners are where w is 0, which clipping must not divide by. */
	{"varying.eye-plane",
		RECTANGLE "	float d = c.y * 5.0 + 5.0;\n"
			  "	gl_Position = vec4(c.x * 100.0, -1.0, d - 1.0, d);\n"
			  "	value = d / 10.0;\n",
		"value", 6, NULL, floor_distance, BYTE, false},
	{"varying.flat",
		RECTANGLE "	gl_Position = vec4(c, 0.0, 1.0);\n"
			  "	value = n == 2 ? 0.25 : n == 5 ? 0.75 : 0.0;\n",
		"value", 6, NULL, last_vertex, BYTE, true},
};

static void use(struct kit *kit, const struct drawing *drawing)
{
	char vertex[1500], fragment[500];
	const char *flat = drawing->flat ? "flat " : "";
	snprintf(vertex, sizeof(vertex),
		"%sout float value;\n"
		"void main() {\n"
		"	int n = gl_VertexID;\n"
		"	value = 1.0;\n"
		"%s"
		"}\n",
		flat, drawing->vertex);
	snprintf(fragment, sizeof(fragment),
		"%sin float value;\n"
		"out vec4 color;\n"
		"float drop(bool dropped) {\n"
		"	if (dropped)\n"
		"		discard;\n"
		"	return 1.0;\n"
		"}\n"
		"void main() {\n"
		"	color = vec4(%s);\n"
		"}\n",
		flat, drawing->expression != NULL ? drawing->expression : "1");
	kit_program(kit, 300, vertex, fragment);
}

static void run_drawing(
	const struct check_case *item, struct check_context *context, struct check_result *result)
{
	static const GLfloat zero[4] = {0, 0, 0, 0};
	static float texels[KIT_TEXELS][4];
	const struct drawing *drawing = item->subject;
	struct kit kit;
	(void)context;
	kit_init(&kit, result);
	GLuint texture = kit_texture(&kit, GL_RGBA8);
	kit_framebuffer(&kit, texture, 0, NULL);
	glClearBufferfv(GL_COLOR, 0, zero);
	use(&kit, drawing);
	if (drawing->set_up != NULL)
		drawing->set_up();
	kit_draw(&kit, drawing->vertices);
	glFrontFace(GL_CCW);
	kit_read(&kit, texture, texels);
	for (size_t i = 0; !kit.failed && i < KIT_TEXELS; i++) {
		double x = (i % KIT_SIZE + .5) / KIT_SIZE * 2 - 1;
		double y = (i / KIT_SIZE + .5) / KIT_SIZE * 2 - 1;
		double truth = drawing->truth(x, y);
		/* A byte over 255 is no exact float. */
		if (!isnan(truth))
			kit_compare(result, texels[i][0], truth, drawing->tolerance + 1e-6);
	}
	if (kit_finish(&kit))
		kit_judge(result, "pixels");
}

void gl_raster_cases(struct check_list *list)
{
	for (size_t i = 0; i < sizeof(drawings) / sizeof(drawings[0]); i++)
		check_list_add(list, run_drawing, &drawings[i], "%s", drawings[i].name);
}
