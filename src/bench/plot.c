/* SPDX-License-Identifier: MIT */
#include "bench/plot.h"
#include "base/array.h"
#include "bench/label.h"
#include "bench/mean.h"
#include "bench/pareto.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Pixels: the chart, and where its axes are. */
#define WIDTH 900
#define HEIGHT 600
#define LEFT 90
#define RIGHT 28
#define TOP 78
#define BOTTOM 66
#define LABEL_FONT 13

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* Told apart with colour-blind eyes too, by marker as well as by colour. */
static const unsigned colors[] = {0x4c4c4c, 0x0072b2, 0xd55e00, 0x009e73, 0xaa3377, 0x9a6f00,
	0x1b8499, 0xcc3311, 0x6a51a3, 0x7a5230};
/* gnuplot's filled ones: circle, square, triangle, turned triangle, diamond, pentagon */
static const int markers[] = {7, 5, 9, 11, 13, 15};

/* The means of each technique in the scene, or in all. */
static struct mean *find_means(
	const struct contents *contents, const struct result *setting, const struct result *scene)
{
	const struct distinct *techniques = &contents->techniques;
	struct mean *means = array_alloc(techniques->count, sizeof(*means));
	for (size_t i = 0; means != NULL && i < techniques->count; i++)
		means[i] = mean_of(contents->results, setting, techniques->items[i], scene);
	return means;
}

static size_t most_scenes(const struct mean *means, size_t count)
{
	size_t most = 0;
	for (size_t i = 0; i < count; i++)
		if (mean_is_complete(&means[i]) && means[i].scenes > most)
			most = means[i].scenes;
	return most;
}

static bool can_be_shown(const struct mean *mean, size_t scenes)
{
	return mean->scenes == scenes && mean_is_complete(mean);
}

static bool all_have_ratios(const struct mean *means, size_t count, size_t scenes)
{
	for (size_t i = 0; i < count; i++)
		if (can_be_shown(&means[i], scenes) && isnan(means[i].ratio))
			return false;
	return true;
}

static void add_points(
	struct plot *plot, const struct contents *contents, const struct mean *means, size_t scenes)
{
	const struct distinct *techniques = &contents->techniques;
	bool ratios = all_have_ratios(means, techniques->count, scenes);
	plot->time_label =
		ratios ? "time of a frame / time of hard shadows" : "time of a frame, ms";
	for (size_t i = 0; i < techniques->count; i++) {
		const struct result *technique = techniques->items[i];
		if (!can_be_shown(&means[i], scenes))
			continue;
		plot->points[plot->count++] = (struct plot_point){
			.label = technique->technique,
			.time = ratios ? means[i].ratio : means[i].ms,
			.error = means[i].rmse,
			.style = distinct_find(&contents->families, technique, same_family),
		};
	}
}

bool plot_init(struct plot *plot, const struct contents *contents, const struct result *setting,
	const struct result *scene, struct sm_error *error)
{
	size_t count = contents->techniques.count;
	struct mean *means = find_means(contents, setting, scene);
	*plot = (struct plot){.points = array_alloc(count, sizeof(*plot->points))};
	bool made = means != NULL && plot->points != NULL;
	char text[120];
	if (made) {
		size_t scenes = most_scenes(means, count);
		if (scene != NULL)
			snprintf(plot->title, sizeof(plot->title), "%s: error against time",
				scene->scene);
		else
			snprintf(plot->title, sizeof(plot->title),
				"Error against time, mean of %zu scene%s", scenes,
				scenes == 1 ? "" : "s");
		setting_describe(setting, text, sizeof(text));
		snprintf(plot->subtitle, sizeof(plot->subtitle), "%s; lower left is better", text);
		add_points(plot, contents, means, scenes);
	}
	free(means);
	return made || error_no_memory(error);
}

void plot_finish(struct plot *plot)
{
	free(plot->points);
	*plot = (struct plot){0};
}

/* A logarithmic axis. */
struct axis {
	double low, high;     /* above 0 */
	double first, extent; /* pixels in the chart */
};

/* The axis that shows each value, or 1 to 10 without any. */
static struct axis find_axis(
	const double (*values)[2], size_t count, int which, double first, double extent)
{
	double low = INFINITY, high = 0;
	for (size_t i = 0; i < count; i++) {
		low = fmin(low, values[i][which]);
		high = fmax(high, values[i][which]);
	}
	if (count == 0)
		return (struct axis){1, 10, first, extent};
	/* Room for markers and texts, and so wide that noise does not look like a difference. */
	double span = high / low;
	double margin = fmax(pow(span, 0.08), fmax(1.15, sqrt(3 / span)));
	return (struct axis){low / margin, high * margin, first, extent};
}

static double position(const struct axis *axis, double value)
{
	return axis->first + axis->extent * log(value / axis->low) / log(axis->high / axis->low);
}

#define TICS_MAX 40

/* Finds steps times powers of ten within the axis. */
static size_t find_tics(const struct axis *axis, const double *steps, double values[TICS_MAX])
{
	size_t count = 0;
	int last = (int)ceil(log10(axis->high));
	for (int decade = (int)floor(log10(axis->low)); decade <= last; decade++)
		for (const double *step = steps; *step > 0 && count < TICS_MAX; step++) {
			double value = *step * pow(10, decade);
			if (value >= axis->low && value <= axis->high)
				values[count++] = value;
		}
	return count;
}

/* Round numbers, no more than are needed to read the axis. */
static void write_tics(const struct axis *axis, char name, FILE *file)
{
	static const double steps[][16] = {{1}, {1, 2, 5}, {1, 1.5, 2, 3, 4, 5, 6, 8},
		{1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9}};
	double values[TICS_MAX];
	size_t count = 0;
	for (size_t i = 0; i < COUNT(steps) && count < 4; i++)
		count = find_tics(axis, steps[i], values);
	fprintf(file, "set %ctics (", name);
	for (size_t i = 0; i < count; i++)
		fprintf(file, "%s%g", i > 0 ? ", " : "", values[i]);
	fputs(")\n", file);
}

/* gnuplot takes what is in single quotes as it is, but for these. */
static void write_string(const char *text, FILE *file)
{
	fputc('\'', file);
	for (; *text != '\0'; text++) {
		if (*text == '\'')
			fputc('\'', file);
		fputc((unsigned char)*text < 0x20 ? ' ' : *text, file);
	}
	fputc('\'', file);
}

static void write_text(
	size_t number, const char *text, double x, double y, const char *look, FILE *file)
{
	fprintf(file, "set label %zu ", number);
	write_string(text, file);
	fprintf(file, " at screen %.5f, %.5f %s\n", x / WIDTH, y / HEIGHT, look);
}

static void write_frame(
	const struct plot *plot, const struct axis *x, const struct axis *y, FILE *file)
{
	fprintf(file,
		"set lmargin at screen %.5f\nset rmargin at screen %.5f\n"
		"set bmargin at screen %.5f\nset tmargin at screen %.5f\n",
		x->first / WIDTH, (x->first + x->extent) / WIDTH, y->first / HEIGHT,
		(y->first + y->extent) / HEIGHT);
	fprintf(file, "set logscale xy\nset xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\n", x->low,
		x->high, y->low, y->high);
	write_tics(x, 'x', file);
	write_tics(y, 'y', file);
	fputs("set border 3 linecolor rgb '#888888'\nset tics nomirror out scale 0.5 textcolor rgb "
	      "'#444444'\nset grid xtics ytics linetype 1 linecolor rgb '#e6e6e6'\nunset key\n",
		file);
	write_text(
		1, plot->title, LEFT, HEIGHT - 26, "left font ',19' textcolor rgb '#222222'", file);
	write_text(2, plot->subtitle, LEFT, HEIGHT - 50, "left font ',13' textcolor rgb '#666666'",
		file);
	write_text(3, plot->time_label, x->first + x->extent / 2, 18,
		"center font ',14' textcolor rgb '#444444'", file);
	write_text(4, "RMSE of visibility in penumbrae", 22, y->first + y->extent / 2,
		"center rotate by 90 font ',14' textcolor rgb '#444444'", file);
}

/* From a point to the text that stands away from it. */
static void write_leader(const struct label *label, FILE *file)
{
	double end[2], apart = 0;
	for (int axis = 0; axis < 2; axis++) {
		double low = label->text.center[axis] - label->text.half[axis];
		double high = label->text.center[axis] + label->text.half[axis];
		end[axis] = fmin(fmax(label->point[axis], low), high);
		apart = fmax(apart, fabs(end[axis] - label->point[axis]));
	}
	if (apart > 12)
		fprintf(file,
			"set arrow from screen %.5f, %.5f to screen %.5f, %.5f nohead back "
			"linecolor rgb '#aaaaaa'\n",
			label->point[0] / WIDTH, label->point[1] / HEIGHT, end[0] / WIDTH,
			end[1] / HEIGHT);
}

static void write_label(
	size_t number, const struct plot_point *point, const struct label *label, FILE *file)
{
	/* Fonts differ in width, so texts are held where they are nearest to their points. */
	double side = label->text.center[0] - label->point[0];
	double x = label->text.center[0];
	const char *align = "center";
	if (fabs(side) > label->text.half[0]) {
		x -= copysign(label->text.half[0], side);
		align = side > 0 ? "left" : "right";
	}
	char look[64];
	snprintf(look, sizeof(look), "%s front font ',%d' textcolor rgb '#%06x'", align, LABEL_FONT,
		colors[point->style % COUNT(colors)]);
	write_leader(label, file);
	write_text(number, point->label, x, label->text.center[1], look, file);
}

/* What is computed of a chart before it is written: arrays of a plot's count, owned. */
struct chart {
	double (*values)[2]; /* time, error */
	struct axis x, y;
	size_t *front; /* points that nothing beats */
	size_t front_count;
	struct label *labels;
	struct box *obstacles; /* to labels: the points, and the lines of the front */
	size_t obstacle_count;
};

static bool chart_alloc(struct chart *chart, size_t count)
{
	chart->values = array_alloc(count, sizeof(*chart->values));
	chart->front = array_alloc(count, sizeof(*chart->front));
	chart->labels = array_alloc(count, sizeof(*chart->labels));
	chart->obstacles = array_alloc(count, 3 * sizeof(*chart->obstacles));
	return chart->values != NULL && chart->front != NULL && chart->labels != NULL &&
	       chart->obstacles != NULL;
}

static void chart_finish(struct chart *chart)
{
	free(chart->values);
	free(chart->front);
	free(chart->labels);
	free(chart->obstacles);
}

static struct box line_box(const double *a, const double *b)
{
	return (struct box){
		.center = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2},
		.half = {fabs(a[0] - b[0]) / 2 + 2, fabs(a[1] - b[1]) / 2 + 2},
	};
}

static void place_labels(struct chart *chart, const struct plot *plot)
{
	const struct box area = {{LEFT + (WIDTH - LEFT) / 2.0, (HEIGHT - TOP + BOTTOM) / 2.0},
		{(WIDTH - LEFT) / 2.0 - 4, (HEIGHT - TOP - BOTTOM) / 2.0}};
	for (size_t i = 0; i < plot->count; i++) {
		/* A sans-serif's letters are about 0.6 as wide as high. */
		double half = 0.3 * LABEL_FONT * (double)strlen(plot->points[i].label);
		double x = position(&chart->x, chart->values[i][0]);
		double y = position(&chart->y, chart->values[i][1]);
		chart->labels[i] = (struct label){{x, y}, {.half = {half, 0.6 * LABEL_FONT}}};
		chart->obstacles[chart->obstacle_count++] = (struct box){{x, y}, {7, 7}};
	}
	for (size_t i = 0; i + 1 < chart->front_count; i++) {
		const double *from = chart->labels[chart->front[i]].point;
		const double *to = chart->labels[chart->front[i + 1]].point;
		const double corner[2] = {to[0], from[1]};
		chart->obstacles[chart->obstacle_count++] = line_box(from, corner);
		chart->obstacles[chart->obstacle_count++] = line_box(corner, to);
	}
	labels_place(chart->labels, plot->count, chart->obstacles, chart->obstacle_count, &area);
}

static void lay_out(struct chart *chart, const struct plot *plot)
{
	const double(*values)[2] = (const double(*)[2])chart->values;
	for (size_t i = 0; i < plot->count; i++) {
		chart->values[i][0] = plot->points[i].time;
		chart->values[i][1] = plot->points[i].error;
	}
	chart->x = find_axis(values, plot->count, 0, LEFT, WIDTH - LEFT - RIGHT);
	chart->y = find_axis(values, plot->count, 1, BOTTOM, HEIGHT - BOTTOM - TOP);
	chart->front_count = pareto_front(values, plot->count, chart->front);
	place_labels(chart, plot);
}

/* The front as steps: for each time, the smallest error that it buys. */
static void write_points(const struct plot *plot, const struct chart *chart, FILE *file)
{
	fputs("$front << END\n", file);
	for (size_t i = 0; i < chart->front_count; i++)
		fprintf(file, "%.9g %.9g\n", chart->values[chart->front[i]][0],
			chart->values[chart->front[i]][1]);
	fputs("END\n$points << END\n", file);
	for (size_t i = 0; i < plot->count; i++)
		fprintf(file, "%.9g %.9g %d 0x%06x\n", chart->values[i][0], chart->values[i][1],
			markers[plot->points[i].style % COUNT(markers)],
			colors[plot->points[i].style % COUNT(colors)]);
	fputs("END\nplot $front with steps linewidth 2 linecolor rgb '#bbbbbb', \\\n"
	      "  $points using 1:2:3:4 with points pointtype variable linecolor rgb "
	      "variable\n",
		file);
}

bool plot_write_script(
	const struct plot *plot, enum plot_format format, FILE *file, struct sm_error *error)
{
	/* Cairo's points are of 96 to an inch, and the sizes of markers differ. */
	static const char *const terminals[PLOT_FORMATS] = {
		[PLOT_SVG] = "set pointsize 1\nset terminal svg font 'sans-serif,14'",
		[PLOT_PNG] =
			"set pointsize 1.6\nset terminal pngcairo font 'sans,14' fontscale 0.75",
	};
	struct chart chart = {0};
	bool made = chart_alloc(&chart, plot->count) || error_no_memory(error);
	if (made) {
		lay_out(&chart, plot);
		fprintf(file, "%s noenhanced background '#ffffff' size %d, %d\n", terminals[format],
			WIDTH, HEIGHT);
		write_frame(plot, &chart.x, &chart.y, file);
		for (size_t i = 0; i < plot->count; i++)
			write_label(i + 5, &plot->points[i], &chart.labels[i], file);
		write_points(plot, &chart, file);
	}
	chart_finish(&chart);
	return made;
}
