/* SPDX-License-Identifier: MIT */
/* How long the search for silhouettes takes, against one that passes nothing over and two plainer
 * edge tables. */
#define _GNU_SOURCE /* twalk_r, sched_setaffinity */
#include "base/array.h"
#include "base/error.h"
#include "bench/statistics.h"
#include "geom/mesh.h"
#include "geom/silhouette_track.h"
#include "models.h"
#include <getopt.h>
#include <malloc.h>
#include <math.h>
#include <sched.h>
#include <search.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define LIGHTS 60
#define ROUNDS 15
#define SAMPLES (LIGHTS * ROUNDS)
#define STEPS 200

/* One record of 16 bytes: t1 is the index of a bit that is never set when there is no triangle. */
struct plain_edge {
	uint32_t v0, v1; /* as t0 runs through it */
	uint32_t t0, t1;
};

struct plain_table {
	size_t count;
	struct plain_edge *edges;
};

/* Found edges; capacity is always enough. */
struct result {
	size_t count;
	struct silhouette_edge *edges;
};

/* What a visitor of the tree needs. */
struct tree_search {
	const uint64_t *facing;
	struct result *result;
};

struct bench {
	struct mesh mesh;
	uint64_t *facing; /* and a word of zeros */
	uint64_t *facing_all;
	struct plain_table plain;
	void *tree; /* of the plain table's edges, by tsearch() */
	size_t tree_bytes;
	struct result packed, all_found, plain_found, tree_found;
};

/* What is timed; ALL: with nothing passed over. */
enum timed {
	FACING,
	PACKED,
	FACING_ALL,
	PACKED_ALL,
	PLAIN,
	TREE,
	BOTH,
	BOTH_ALL,
	BOTH_PLAIN,
	TIMED
};

static bool has_bit(const uint64_t *words, uint32_t i)
{
	return words[i / 64] >> i % 64 & 1;
}

static inline void test_edge(
	const struct plain_edge *edge, const uint64_t *facing, struct result *result)
{
	bool own = has_bit(facing, edge->t0);
	if (own != has_bit(facing, edge->t1))
		result->edges[result->count++] = own ? (struct silhouette_edge){edge->v0, edge->v1}
						     : (struct silhouette_edge){edge->v1, edge->v0};
}

static void search_plain(
	const struct plain_table *table, const uint64_t *facing, struct result *result)
{
	result->count = 0;
	for (size_t e = 0; e < table->count; e++)
		test_edge(&table->edges[e], facing, result);
}

static void visit_node(const void *node, VISIT order, void *closure)
{
	const struct tree_search *search = closure;
	if (order == postorder || order == leaf)
		test_edge(*(struct plain_edge *const *)node, search->facing, search->result);
}

static void search_tree(const void *tree, const uint64_t *facing, struct result *result)
{
	result->count = 0;
	twalk_r(tree, visit_node, &(struct tree_search){facing, result});
}

static int compare_words(const void *a, const void *b)
{
	const uint32_t *x = a, *y = b;
	for (int i = 0; i < 4; i++)
		if (x[i] != y[i])
			return x[i] < y[i] ? -1 : 1;
	return 0;
}

static bool build_plain(struct bench *bench)
{
	const struct caster *caster = &bench->mesh.caster;
	size_t count = edge_table_records(&caster->edges);
	uint32_t never = (uint32_t)(EDGE_BLOCK * facing_words(caster));
	struct edge_record *records = array_alloc(count, sizeof(*records));
	bench->plain = (struct plain_table){count, array_alloc(count, sizeof(struct plain_edge))};
	bool ok = records != NULL && bench->plain.edges != NULL;
	if (ok)
		edge_table_decode(&caster->edges, records);
	for (size_t i = 0; ok && i < count; i++) {
		size_t t = records[i].corner / 3, k = records[i].corner % 3;
		bench->plain.edges[i] = (struct plain_edge){
			.v0 = caster->indices[3 * t + k],
			.v1 = caster->indices[3 * t + (k + 1) % 3],
			.t0 = (uint32_t)t,
			.t1 = records[i].neighbour == EDGE_OPEN ? never : records[i].neighbour,
		};
	}
	free(records);
	return ok;
}

static bool build_tree(struct bench *bench)
{
	size_t before = mallinfo2().uordblks;
	for (size_t i = 0; i < bench->plain.count; i++)
		if (tsearch(&bench->plain.edges[i], &bench->tree, compare_words) == NULL)
			return false;
	bench->tree_bytes =
		mallinfo2().uordblks - before + bench->plain.count * sizeof(*bench->plain.edges);
	return true;
}

static void keep(void *edge)
{
	(void)edge; /* belongs to the plain table */
}

static void bench_finish(struct bench *bench)
{
	tdestroy(bench->tree, keep);
	free(bench->plain.edges);
	free(bench->facing);
	free(bench->facing_all);
	free(bench->packed.edges);
	free(bench->all_found.edges);
	free(bench->plain_found.edges);
	free(bench->tree_found.edges);
	mesh_finish(&bench->mesh);
}

static bool bench_init(
	struct bench *bench, const char *name, const struct model *model, struct sm_error *error)
{
	*bench = (struct bench){.tree = NULL};
	struct sm_mesh_desc desc = model_desc(model, name);
	if (!mesh_init(&bench->mesh, &desc, error))
		return false;
	const struct caster *caster = &bench->mesh.caster;
	size_t count = edge_table_records(&caster->edges);
	size_t size = sizeof(struct silhouette_edge);
	bench->facing = array_zalloc(facing_words(caster) + 1, sizeof(*bench->facing));
	bench->facing_all = array_zalloc(facing_words(caster), sizeof(*bench->facing_all));
	bench->packed.edges = array_zalloc(count, size);
	bench->all_found.edges = array_zalloc(count, size);
	bench->plain_found.edges = array_zalloc(count, size);
	bench->tree_found.edges = array_zalloc(count, size);
	if (bench->facing == NULL || bench->facing_all == NULL || bench->packed.edges == NULL ||
		bench->all_found.edges == NULL || bench->plain_found.edges == NULL ||
		bench->tree_found.edges == NULL || !build_plain(bench) || !build_tree(bench)) {
		bench_finish(bench);
		return error_no_memory(error);
	}
	return true;
}

static double now(void)
{
	struct timespec time;
	clock_gettime(CLOCK_MONOTONIC, &time);
	return (double)time.tv_sec * 1e9 + (double)time.tv_nsec;
}

static void search_once(struct bench *bench, enum timed what, const float light[4])
{
	const struct caster *caster = &bench->mesh.caster;
	size_t capacity = edge_table_records(&caster->edges);
	if (what == FACING)
		facing_find(caster, light, bench->facing);
	if (what == PACKED)
		bench->packed.count =
			silhouette_find(caster, bench->facing, bench->packed.edges, capacity);
	if (what == FACING_ALL)
		facing_find_all(caster, light, bench->facing_all);
	if (what == PACKED_ALL)
		bench->all_found.count = silhouette_find_all(
			caster, bench->facing, bench->all_found.edges, capacity);
	if (what == PLAIN)
		search_plain(&bench->plain, bench->facing, &bench->plain_found);
	if (what == TREE)
		search_tree(bench->tree, bench->facing, &bench->tree_found);
}

/* One light with each search in turn; ns. Each runs once before, so that none finds the caches as
 * another left them. */
static void search_all(struct bench *bench, const float light[4], bool tree, double ns[TIMED])
{
	for (enum timed what = FACING; what <= (tree ? TREE : PLAIN); what++) {
		search_once(bench, what, light);
		double start = now();
		search_once(bench, what, light);
		ns[what] = now() - start;
	}
	ns[BOTH] = ns[FACING] + ns[PACKED];
	ns[BOTH_ALL] = ns[FACING_ALL] + ns[PACKED_ALL];
	ns[BOTH_PLAIN] = ns[FACING_ALL] + ns[PLAIN];
}

static int compare_edges(const void *a, const void *b)
{
	const struct silhouette_edge *x = a, *y = b;
	if (x->a != y->a)
		return x->a < y->a ? -1 : 1;
	return x->b < y->b ? -1 : x->b > y->b;
}

static bool agree(struct bench *bench)
{
	struct result *results[] = {
		&bench->packed, &bench->all_found, &bench->plain_found, &bench->tree_found};
	if (memcmp(bench->facing, bench->facing_all,
		    facing_words(&bench->mesh.caster) * sizeof(*bench->facing)) != 0)
		return false;
	for (int i = 0; i < 4; i++) {
		qsort(results[i]->edges, results[i]->count, sizeof(*results[i]->edges),
			compare_edges);
		if (results[i]->count != results[0]->count ||
			memcmp(results[i]->edges, results[0]->edges,
				results[0]->count * sizeof(*results[0]->edges)) != 0)
			return false;
	}
	return true;
}

static void light_on_circle(const struct caster *caster, double degrees, float light[4])
{
	const struct face_planes *planes = &caster->planes;
	double angle = 3.14159265358979 / 180.0 * degrees;
	light[0] = (float)(planes->center[0] + 3.0 * planes->radius * cos(angle));
	light[1] = (float)(planes->center[1] + 2.0 * planes->radius);
	light[2] = (float)(planes->center[2] + 3.0 * planes->radius * sin(angle));
	light[3] = 1.0f;
}

/* What is found with one light, on average. */
struct findings {
	double edges;   /* on the silhouette */
	double decided; /* share of blocks */
};

static double decided_share(const struct caster *caster, const float light[4])
{
	struct cone_light seen;
	size_t decided = 0;
	if (!cone_light_of(&caster->planes, light, &seen))
		return 0.0;
	for (size_t b = 0; b < caster->cones.count; b += CONE_BATCH) {
		uint8_t sides[CONE_BATCH];
		face_cones_test(&caster->cones, b, &seen, sides);
		for (int i = 0; i < CONE_BATCH; i++)
			decided += sides[i] != CONE_MIXED;
	}
	return (double)decided / (double)facing_words(caster);
}

/* Medians per edge; false when the searches disagree. */
static bool measure(struct bench *bench, double ns[TIMED], struct findings *findings)
{
	static double samples[TIMED][SAMPLES];
	*findings = (struct findings){0};
	for (int s = 0; s < SAMPLES; s++) {
		float light[4];
		double once[TIMED] = {0};
		light_on_circle(&bench->mesh.caster, 360.0 / LIGHTS * (s % LIGHTS), light);
		search_all(bench, light, s < LIGHTS, once);
		for (int i = 0; i < TIMED; i++)
			samples[i][s] = once[i];
		findings->edges += (double)bench->packed.count / SAMPLES;
		findings->decided += decided_share(&bench->mesh.caster, light) / SAMPLES;
		if (s < LIGHTS && !agree(bench))
			return false;
	}
	for (int i = 0; i < TIMED; i++)
		ns[i] = statistics_median(samples[i], i == TREE ? LIGHTS : SAMPLES) /
			(double)bench->plain.count;
	return true;
}

static void print_row(const char *what, double ns, double ratio, double bytes)
{
	printf("  %-34s %9.3f %9.2f %12.2f\n", what, ns, ratio, bytes);
}

static void report(const struct bench *bench, const char *name, const double ns[TIMED],
	const struct findings *findings)
{
	const struct caster *caster = &bench->mesh.caster;
	double edges = (double)bench->plain.count;
	double table = (double)edge_table_bytes(&caster->edges) / edges;
	double planes = (double)face_planes_bytes(&caster->planes) / edges;
	double cones = (double)face_cones_bytes(&caster->cones) / edges;
	double plain = (double)sizeof(struct plain_edge);
	printf("%s: %zu triangles, %.0f edges, %.0f on the silhouette, %.0f %% of %zu blocks "
	       "decided\n",
		name, caster->triangle_count, edges, findings->edges, 100.0 * findings->decided,
		facing_words(caster));
	printf("  %-34s %9s %9s %12s\n", "", "ns/edge", "ratio", "bytes/edge");
	print_row("search", ns[BOTH], 1.0, table + planes + cones);
	print_row("  facing of triangles", ns[FACING], ns[FACING] / ns[BOTH], planes + cones);
	print_row("  packed table", ns[PACKED], ns[PACKED] / ns[BOTH], table);
	print_row("nothing passed over", ns[BOTH_ALL], ns[BOTH_ALL] / ns[BOTH], table + planes);
	print_row("  facing of triangles", ns[FACING_ALL], ns[FACING_ALL] / ns[BOTH], planes);
	print_row("  packed table", ns[PACKED_ALL], ns[PACKED_ALL] / ns[BOTH], table);
	print_row("facing, and plain 16-byte table", ns[BOTH_PLAIN], ns[BOTH_PLAIN] / ns[BOTH],
		plain + planes);
	print_row("red-black tree, edges alone", ns[TREE], ns[TREE] / ns[BOTH],
		(double)bench->tree_bytes / edges);
}

/* A light that goes on by one angle, and what tracking it takes; per edge, and shares of blocks. */
struct tracking {
	double degrees; /* 0: it jumps */
	double all, track;
	double tested, searched, bytes;
};

static bool same_silhouette(const struct bench *bench, const struct silhouette_track *track)
{
	size_t words = facing_words(&bench->mesh.caster);
	const struct result *all = &bench->all_found;
	return track->edge_count == all->count &&
	       memcmp(track->edges, all->edges, all->count * sizeof(*all->edges)) == 0 &&
	       memcmp(track->facing.facing, bench->facing_all, words * sizeof(uint64_t)) == 0;
}

static bool measure_step(struct bench *bench, struct silhouette_track *track, const float light[4],
	double *all, double *tracked)
{
	const struct caster *caster = &bench->mesh.caster;
	double start = now();
	facing_find_all(caster, light, bench->facing_all);
	bench->all_found.count = silhouette_find_all(caster, bench->facing_all,
		bench->all_found.edges, edge_table_records(&caster->edges));
	double middle = now();
	bool ok = silhouette_track(track, caster, light, NULL);
	*tracked = now() - middle;
	*all = middle - start;
	return ok && same_silhouette(bench, track);
}

/* Medians; false when the searches disagree. */
static bool measure_tracking(struct bench *bench, struct tracking *tracking)
{
	static double all[STEPS], tracked[STEPS];
	const struct caster *caster = &bench->mesh.caster;
	double edges = (double)bench->plain.count, blocks = (double)facing_words(caster);
	struct silhouette_track track = {0};
	bool same = true;
	for (int i = 0; i < STEPS && same; i++) {
		float light[4];
		/* 137.5 degrees, the golden angle, is never near where it has just been. */
		double degrees = i * (tracking->degrees > 0.0 ? tracking->degrees : 137.5);
		light_on_circle(caster, degrees, light);
		same = measure_step(bench, &track, light, &all[i], &tracked[i]);
		tracking->tested += (double)track.tested / blocks / STEPS;
		tracking->searched += (double)track.searched / blocks / STEPS;
	}
	tracking->all = statistics_median(all, STEPS) / edges;
	tracking->track = statistics_median(tracked, STEPS) / edges;
	tracking->bytes = (double)silhouette_track_bytes(&track) / edges;
	silhouette_track_finish(&track);
	return same;
}

static bool report_tracking(struct bench *bench)
{
	const double steps[] = {0.1, 0.25, 0.5, 1.0, 5.0, 0.0};
	printf("  %-34s %9s %9s %12s %8s %9s\n", "tracked, a step", "ns/edge", "faster",
		"bytes/edge", "tested", "searched");
	for (size_t i = 0; i < sizeof(steps) / sizeof(steps[0]); i++) {
		struct tracking tracking = {.degrees = steps[i]};
		char title[32] = "  jumps";
		if (!measure_tracking(bench, &tracking))
			return false;
		if (steps[i] > 0.0)
			snprintf(title, sizeof(title), "  %g degrees", steps[i]);
		printf("  %-34s %9.3f %9.2f %12.2f %6.1f %% %7.1f %%\n", title, tracking.track,
			tracking.all / tracking.track, tracking.bytes, 100.0 * tracking.tested,
			100.0 * tracking.searched);
	}
	return true;
}

/* Where the process may run. */
static cpu_set_t all_cores;

/* The scheduler must not move the measurement from one cache to another. */
static void stay_on_this_core(void)
{
	cpu_set_t set;
	CPU_ZERO(&set);
	CPU_SET((size_t)sched_getcpu(), &set);
	if (sched_setaffinity(0, sizeof(set), &set) != 0)
		perror("bench-silhouette: sched_setaffinity");
}

static double time_track(struct silhouette_track *track, const struct caster *caster,
	const float light[4], struct workers *workers, bool *ok)
{
	double start = now();
	*ok = *ok && silhouette_track(track, caster, light, workers);
	return now() - start;
}

/* Medians of tracking alone, and with others; false when these find something else. */
static bool measure_sharing(
	struct bench *bench, struct workers *workers, double degrees, double *alone, double *shared)
{
	static double ns[2][STEPS];
	const struct caster *caster = &bench->mesh.caster;
	struct silhouette_track tracks[2] = {{0}};
	bool ok = true;
	for (int i = 0; i < STEPS && ok; i++) {
		float light[4];
		light_on_circle(caster, i * degrees, light);
		ns[0][i] = time_track(&tracks[0], caster, light, NULL, &ok);
		ns[1][i] = time_track(&tracks[1], caster, light, workers, &ok);
		ok = ok && tracks[0].edge_count == tracks[1].edge_count &&
		     memcmp(tracks[0].edges, tracks[1].edges,
			     tracks[0].edge_count * sizeof(*tracks[0].edges)) == 0;
	}
	silhouette_track_finish(&tracks[0]);
	silhouette_track_finish(&tracks[1]);
	*alone = statistics_median(ns[0], STEPS) / (double)bench->plain.count;
	*shared = statistics_median(ns[1], STEPS) / (double)bench->plain.count;
	return ok;
}

/* On all cores, but with its own work on any of them. */
static bool report_sharing(struct bench *bench)
{
	const double steps[] = {1.0, 137.5};
	const char *const titles[] = {"  1 degrees", "  jumps"};
	struct workers workers = {0};
	bool ok = true;
	if (bench->mesh.caster.triangle_count < TRACK_SHARED_MIN ||
		sched_setaffinity(0, sizeof(all_cores), &all_cores) != 0)
		return true;
	unsigned count = workers_share(&workers);
	if (count > 1)
		printf("  tracked by %u threads\n", count);
	for (size_t i = 0; i < 2 && count > 1 && ok; i++) {
		double alone = 0.0, shared = 0.0;
		ok = measure_sharing(bench, &workers, steps[i], &alone, &shared);
		printf("  %-34s %9.3f %9.2f times as fast as by one\n", titles[i], shared,
			alone / shared);
	}
	workers_finish(&workers);
	stay_on_this_core();
	return ok;
}

static int run(const char *name, struct model *model)
{
	struct bench bench;
	struct sm_error error;
	struct findings findings;
	double ns[TIMED];
	if (!bench_init(&bench, name, model, &error)) {
		fprintf(stderr, "bench-silhouette: %s\n", error.text);
		return error.status;
	}
	bool ok = measure(&bench, ns, &findings);
	if (ok)
		report(&bench, name, ns, &findings);
	ok = ok && report_tracking(&bench) && report_sharing(&bench);
	if (!ok)
		fprintf(stderr, "bench-silhouette: %s: the searches disagree\n", name);
	bench_finish(&bench);
	return ok ? SM_OK : SM_ERROR_MACHINE;
}

/* Runs a model with each edge split into `parts`. */
static int run_split(const char *name, struct model *model, unsigned parts)
{
	char title[4096];
	struct model split = model_split(model, parts);
	snprintf(title, sizeof(title), "%s, edges split by %u", name, parts);
	int status = run(parts == 1 ? name : title, &split);
	model_finish(&split);
	return status;
}

static int run_file(const char *path, unsigned parts)
{
	struct model model;
	if (!model_load(&model, path)) {
		fprintf(stderr, "bench-silhouette: %s: cannot be read\n", path);
		return SM_ERROR_INPUT;
	}
	int status = run_split(path, &model, parts);
	model_finish(&model);
	return status;
}

static int run_default(unsigned parts)
{
	struct model model;
	const char *path = SMOOTHIE_SHARED "/models/toy-car.glb";
	bool loaded = model_load(&model, path);
	if (!loaded)
		model = model_sphere(7);
	int status = run_split(loaded ? path : "sphere", &model, parts);
	model_finish(&model);
	return status;
}

static void print_usage(FILE *out)
{
	fprintf(out,
		"Usage: bench-silhouette [-s PARTS] [MODEL]...\n"
		"Times the search for silhouettes on one core, for %d lights on a circle, %d\n"
		"times each, but the tree once; and how long one takes that is tracked as it goes\n"
		"around, for %d steps of several angles; for large meshes also by threads, on\n"
		"all cores. Prints medians. Without MODEL:\n"
		"toy-car.glb when it is there, or a sphere.\n"
		"  -s PARTS  split each edge into PARTS, 1 to 9, and so each triangle\n"
		"Exit status: 1 when the searches disagree, 2 when a MODEL cannot be used.\n",
		LIGHTS, ROUNDS, STEPS);
}

int main(int argc, char **argv)
{
	static const struct option options[] = {{"help", no_argument, NULL, 'h'}, {0}};
	unsigned parts = 1;
	int option;
	while ((option = getopt_long(argc, argv, "hs:", options, NULL)) != -1) {
		if (option == 's' && optarg[0] >= '1' && optarg[0] <= '9' && optarg[1] == '\0') {
			parts = (unsigned)(optarg[0] - '0');
			continue;
		}
		print_usage(option == 'h' ? stdout : stderr);
		return option == 'h' ? SM_OK : SM_ERROR_INPUT;
	}
	if (sched_getaffinity(0, sizeof(all_cores), &all_cores) != 0)
		perror("bench-silhouette: sched_getaffinity");
	stay_on_this_core();
	int status = SM_OK;
	if (optind == argc)
		status = run_default(parts);
	for (int i = optind; i < argc && status == SM_OK; i++)
		status = run_file(argv[i], parts);
	return status;
}
