/* SPDX-License-Identifier: MIT */
#include "bench/paper_report.h"
#include <math.h>

/* Where a number belongs; 0, NAN and "" are left empty. */
struct place {
	const char *table, *name, *technique;
	uint32_t map;
	double t;
};

static void write_line(
	FILE *file, struct place place, const char *quantity, double value, const char *unit)
{
	if (!isfinite(value))
		return;
	/* No name has quotes in it. */
	fprintf(file, "%s,\"%s\",%s,", place.table, place.name, place.technique);
	if (place.map > 0)
		fprintf(file, "%u", place.map);
	fputc(',', file);
	if (isfinite(place.t))
		fprintf(file, "%g", place.t);
	fprintf(file, ",%s,%.9g,%s\n", quantity, value, unit);
}

static void write_quality(
	FILE *file, struct place place, const char *quantity, struct paper_quality quality)
{
	place.technique = paper_technique_names[PAPER_HARD];
	write_line(file, place, quantity, quality.hard, "visibility");
	place.technique = paper_technique_names[PAPER_SMOOTHIE];
	write_line(file, place, quantity, quality.smoothie, "visibility");
}

static void write_scene(FILE *file, const struct paper_scene *scene)
{
	struct place place = {"scenes", scene->name, "", 0, NAN};
	write_line(file, place, "triangles", (double)scene->triangles, "count");
	write_line(file, place, "edges", (double)scene->edges, "count");
	write_line(file, place, "open edges", (double)scene->open_edges, "count");
	write_line(file, place, "odd edges", (double)scene->odd_edges, "count");
	write_line(file, place, "silhouette edges", (double)scene->silhouette_edges, "count");
	write_line(file, place, "fins", (double)scene->fins, "count");
	write_quality(file, place, "aliasing", scene->aliasing);
	write_quality(file, place, "popping", scene->popping);
	for (int technique = 0; technique < PAPER_TECHNIQUES; technique++)
		for (int map = 0; map < PAPER_MAPS; map++) {
			place.technique = paper_technique_names[technique];
			place.map = paper_maps[map];
			write_line(file, place, "frame", scene->ms[technique][map], "ms");
		}
	place.technique = paper_technique_names[PAPER_SMOOTHIE];
	place.map = paper_maps[PAPER_WIDTH_MAP];
	for (int w = 0; w < PAPER_WIDTHS; w++) {
		place.t = paper_widths[w];
		write_line(file, place, "frame", scene->width_ms[w], "ms");
	}
	place.t = NAN;
	place.technique = "penumbra-map";
	place.map = paper_maps[PAPER_MAPS - 1];
	write_line(file, place, "frame", scene->penumbra_map_ms, "ms");
	place.technique = "maps-16";
	place.map = paper_maps[1];
	write_line(file, place, "frame", scene->many_maps_ms, "ms");
}

static void write_mesh(FILE *file, const struct paper_mesh *mesh)
{
	char name[48];
	snprintf(name, sizeof(name), "%s of %llu edges", mesh->shape,
		(unsigned long long)mesh->edges);
	struct place place = {"edges", name, paper_technique_names[PAPER_SMOOTHIE], 0, NAN};
	write_line(file, place, "edges", (double)mesh->edges, "count");
	write_line(file, place, "silhouette edges", (double)mesh->silhouette_edges, "count");
	write_line(file, place, "fins", (double)mesh->fins, "count");
	write_line(file, place, "silhouettes", mesh->ms, "ms");
}

static void write_size(FILE *file, const struct paper_size *size)
{
	struct place place = {"maps", "urchin", paper_technique_names[PAPER_HARD], size->map, NAN};
	write_line(file, place, "shadow map", size->shadow_map, "ms");
	write_line(file, place, "frame", size->hard_frame, "ms");
	place.technique = paper_technique_names[PAPER_SMOOTHIE];
	write_line(file, place, "buffers", size->buffers, "ms");
	write_line(file, place, "frame", size->smoothie_frame, "ms");
}

static void write_error(
	FILE *file, const char *name, const char *technique, double t, struct paper_error error)
{
	struct place place = {"errors", name, technique, 0, t};
	write_line(file, place, "penumbra RMSE", error.rmse, "visibility");
	write_line(file, place, "bias", error.bias, "visibility");
}

static void write_precision(FILE *file, const char *technique, struct paper_precision precision)
{
	struct place place = {"errors", "study scenes", technique, 0, NAN};
	write_error(file, place.name, technique, NAN, precision.error);
	write_line(file, place, "difference from floats", precision.difference, "visibility");
}

void paper_csv_write(const struct paper_result *result, FILE *file)
{
	fputs("table,name,technique,map,t,quantity,value,unit\n", file);
	for (size_t i = 0; i < result->scene_count; i++)
		write_scene(file, &result->scenes[i]);
	for (size_t i = 0; i < result->mesh_count; i++)
		write_mesh(file, &result->meshes[i]);
	for (size_t i = 0; i < result->size_count; i++)
		write_size(file, &result->sizes[i]);
	write_error(file, "study scenes", "hard", NAN, result->hard);
	write_error(file, "study scenes", "smoothie", NAN, result->linear);
	write_error(file, "study scenes", "smoothie with a sinusoid", NAN, result->sinusoid);
	write_precision(file, "smoothie in half", result->half);
	write_precision(file, "smoothie in fixed12", result->fixed12);
	write_error(file, "fence", "smoothie", .02, result->thin);
	write_error(file, "fence", "smoothie", .08, result->thick);
	struct place snapping = {"snapping", "knot of few triangles", "smoothie", 0, .1};
	write_line(file, snapping, "largest change", result->snapping_coarse, "ratio");
	snapping.name = "knot of many triangles";
	write_line(file, snapping, "largest change", result->snapping_fine, "ratio");
}
