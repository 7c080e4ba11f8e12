/* SPDX-License-Identifier: MIT */
#include "bench/paper_claim.h"
#include "bench/paper_fit.h"
#include "bench/paper_report.h"
#include "bench/paper_volokh.h"
#include <inttypes.h>
#include <math.h>

static void write_cell(FILE *file, int digits, double value)
{
	if (isfinite(value))
		fprintf(file, " %.*f |", digits, value);
	else
		fputs(" |", file);
}

static void write_head(FILE *file, const struct paper_result *result)
{
	static const char *const keys[] = {
		"version", "commit", "date", "command", "system", "processor", "cores"};
	fputs("# The papers' own tables\n\n"
	      "What Chan & Durand report in \"Rendering Fake Soft Shadows with Smoothies\" (2003), "
	      "and Volokh of\n"
	      "[his implementation](https://github.com/svolokh/FakeSoftShadows), measured here; "
	      "then each claim, with\n"
	      "what we find of it. Made by `smoothie bench --paper`; the numbers are in "
	      "paper.csv.\n\n",
		file);
	for (size_t i = 0; i < sizeof(keys) / sizeof(keys[0]); i++) {
		const char *value = run_facts_get(&result->facts, keys[i]);
		if (value[0] != '\0')
			fprintf(file, "- %s: %s\n", keys[i], value);
	}
	fprintf(file, "- driver: %s, %s\n", result->renderer, result->driver);
	fprintf(file,
		"- pictures of %ux%u; medians of %u frames; techniques and maps in turns, frame by "
		"frame\n"
		"- all in %.0f s\n\n",
		result->picture, result->picture, result->rounds, result->seconds);
}

static void write_scene_counts(FILE *file, const struct paper_scene *scene)
{
	fprintf(file,
		"| %s | %u | %" PRIu64 " | %" PRIu64 " | %" PRIu64 " | %" PRIu64 " | %" PRIu64
		" | %" PRIu64 " |\n",
		scene->name, scene->wanted, scene->triangles, scene->edges, scene->open_edges,
		scene->odd_edges, scene->silhouette_edges, scene->fins);
}

static void write_scene_times(FILE *file, const struct paper_scene *scene)
{
	fprintf(file, "| %s |", scene->name);
	for (int technique = 0; technique < PAPER_TECHNIQUES; technique++)
		for (int map = 0; map < PAPER_MAPS; map++)
			write_cell(file, 1, scene->ms[technique][map]);
	write_cell(file, 1, scene->many_maps_ms);
	write_cell(file, 1, scene->penumbra_map_ms);
	fputc('\n', file);
}

static void write_scene_widths(FILE *file, const struct paper_scene *scene)
{
	fprintf(file, "| %s |", scene->name);
	double most = NAN;
	for (int w = 0; w < PAPER_WIDTHS; w++) {
		write_cell(file, 1, scene->width_ms[w]);
		most = fmax(most, scene->width_ms[w]);
	}
	write_cell(file, 2, most / scene->width_ms[0]);
	fputc('\n', file);
}

static void write_scene_qualities(FILE *file, const struct paper_scene *scene)
{
	fprintf(file, "| %s |", scene->name);
	write_cell(file, 4, scene->aliasing.hard);
	write_cell(file, 4, scene->aliasing.smoothie);
	write_cell(file, 4, scene->popping.hard);
	write_cell(file, 4, scene->popping.smoothie);
	fputc('\n', file);
}

static void write_scene_table(FILE *file, const struct paper_result *result, const char *head,
	void (*write)(FILE *file, const struct paper_scene *scene))
{
	fputs(head, file);
	for (size_t i = 0; i < result->scene_count; i++)
		write(file, &result->scenes[i]);
	fputc('\n', file);
}

static void write_scenes(FILE *file, const struct paper_result *result)
{
	fputs("## Scenes of the paper's sizes\n\n"
	      "Chan & Durand's scenes have 5.7k, 9.4k, 26k, 39k and 51k triangles. Those named "
	      "\"generated\" are made by\n"
	      "`builtin:SHAPE:N`. The debris has as many triangles as the urchin and many more "
	      "silhouette edges. Odd edges have\n"
	      "more than two triangles.\n\n",
		file);
	write_scene_table(file, result,
		"| scene | triangles of the paper's | here | edges | open | odd | silhouette edges "
		"| fins |\n"
		"|---|--:|--:|--:|--:|--:|--:|--:|\n",
		write_scene_counts);
	fputs("Milliseconds a frame, by texels a side of the shadow map. \"16 maps\" is the "
	      "average of 16 hard shadows.\n\n",
		file);
	write_scene_table(file, result,
		"| scene | hard 256 | 512 | 1024 | smoothie 256 | 512 | 1024 | bicubic 256 | 512 | "
		"1024 | 16 maps 512 | penumbra map 1024 |\n"
		"|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
		write_scene_times);
	fputs("Milliseconds a frame with fins of the same width t everywhere, map of 512.\n\n",
		file);
	write_scene_table(file, result,
		"| scene | t = .02 | .05 | .1 | .2 | slowest / t = .02 |\n"
		"|---|--:|--:|--:|--:|--:|\n",
		write_scene_widths);
	fputs("Aliasing: RMSE of the visibility that is drawn with a map of 512 against that with "
	      "one of 4096, the technique\n"
	      "being the same. Popping: RMS change of visibility from frame to frame, under a "
	      "light that turns by .1 degrees each.\n\n",
		file);
	write_scene_table(file, result,
		"| scene | aliasing, hard | smoothie | popping, hard | smoothie |\n"
		"|---|--:|--:|--:|--:|\n",
		write_scene_qualities);
}

/* Which part of the time goes with edges, and which with silhouette edges. */
static void write_split(FILE *file, const struct paper_result *result)
{
	double edges[PAPER_MESHES_MAX], silhouettes[PAPER_MESHES_MAX], ms[PAPER_MESHES_MAX];
	double per_edge, per_silhouette;
	for (size_t i = 0; i < result->mesh_count; i++) {
		edges[i] = (double)result->meshes[i].edges;
		silhouettes[i] = (double)result->meshes[i].silhouette_edges;
		ms[i] = result->meshes[i].ms;
	}
	/* Noise may make one of them negative, which says nothing. */
	if (fit_two(edges, silhouettes, ms, result->mesh_count, &per_edge, &per_silhouette) &&
		per_edge > 0 && per_silhouette > 0)
		fprintf(file,
			"Best fit: %.1f ns an edge, to find silhouettes, and %.0f ns a silhouette "
			"edge, to make fins.\n\n",
			1e6 * per_edge, 1e6 * per_silhouette);
}

static void write_meshes(FILE *file, const struct paper_result *result)
{
	fprintf(file,
		"## Silhouettes and fins against edges (Volokh's Figure 4)\n\n"
		"![time against edges](%s.svg)\n\n"
		"Milliseconds to find silhouettes, to make fins and to hand them to the driver. "
		"Silhouettes of the urchin grow with\n"
		"the root of its edges, those of the debris with the edges.\n\n",
		paper_plot_name(PAPER_PLOT_MESHES));
	write_split(file, result);
	fputs("| mesh | edges | silhouette edges | fins | ms | ns an edge |\n"
	      "|---|--:|--:|--:|--:|--:|\n",
		file);
	for (size_t i = 0; i < result->mesh_count; i++) {
		const struct paper_mesh *mesh = &result->meshes[i];
		fprintf(file, "| %s | %" PRIu64 " | %" PRIu64 " | %" PRIu64 " |", mesh->shape,
			mesh->edges, mesh->silhouette_edges, mesh->fins);
		write_cell(file, 3, mesh->ms);
		/* A mesh has edges. */
		write_cell(file, 1, 1e6 * mesh->ms / (double)mesh->edges);
		fputc('\n', file);
	}
	const struct volokh_mesh *volokh;
	for (size_t i = 0; (volokh = volokh_mesh(i)) != NULL; i++)
		fprintf(file, "| Volokh's | %.0f | | | %.2f | %.1f |\n", volokh->edges, volokh->ms,
			1e6 * volokh->ms / volokh->edges);
	fputc('\n', file);
}

static void write_sizes(FILE *file, const struct paper_result *result)
{
	fprintf(file,
		"## Shadow map alone and with smoothie buffers (Volokh's Figure 5)\n\n"
		"![time against the size of the map](%s.svg)\n\n"
		"A scene of %" PRIu64
		" edges, milliseconds. Buffers: what smoothies draw besides the shadow map, the "
		"fins being there. Volokh's are of\n"
		"another machine, with a GPU: compare the ratios.\n\n"
		"| map | shadow map | buffers | both / shadow map | frame, hard | frame, smoothie "
		"| "
		"Volokh: shadow map | both | ratio |\n"
		"|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
		paper_plot_name(PAPER_PLOT_SIZES), result->size_edges);
	for (size_t i = 0; i < result->size_count; i++) {
		const struct paper_size *size = &result->sizes[i];
		fprintf(file, "| %u |", size->map);
		write_cell(file, 2, size->shadow_map);
		write_cell(file, 2, size->buffers);
		write_cell(file, 2, 1 + size->buffers / size->shadow_map);
		write_cell(file, 1, size->hard_frame);
		write_cell(file, 1, size->smoothie_frame);
		const struct volokh_size *volokh = NULL;
		for (size_t k = 0; (volokh = volokh_size(k)) != NULL; k++)
			if (volokh->map == (double)size->map)
				break;
		write_cell(file, 1, volokh != NULL ? volokh->shadow_map : NAN);
		write_cell(file, 1, volokh != NULL ? volokh->with_buffers : NAN);
		write_cell(
			file, 2, volokh != NULL ? volokh->with_buffers / volokh->shadow_map : NAN);
		fputc('\n', file);
	}
	fputc('\n', file);
}

static void write_claims(FILE *file, const struct paper_result *result)
{
	struct paper_claim claims[PAPER_CLAIMS_MAX];
	size_t count = paper_claims_judge(result, claims);
	fputs("## Claims\n\n"
	      "Each verdict follows from the numbers beside it, by the rule that stands with "
	      "them. \"In part\": for some scenes, or\n"
	      "less than wanted.\n\n"
	      "| claim | of | here | our numbers |\n"
	      "|---|---|---|---|\n",
		file);
	for (size_t i = 0; i < count; i++)
		fprintf(file, "| %s | %s | **%s** | %s |\n", claims[i].text, claims[i].source,
			verdict_name(claims[i].verdict), claims[i].evidence);
}

void paper_markdown_write(const struct paper_result *result, FILE *file)
{
	write_head(file, result);
	write_scenes(file, result);
	write_meshes(file, result);
	write_sizes(file, result);
	write_claims(file, result);
}
