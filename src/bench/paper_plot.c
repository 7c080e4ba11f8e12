/* SPDX-License-Identifier: MIT */
#include "bench/paper_report.h"
#include "bench/paper_volokh.h"
#include <math.h>
#include <string.h>

const char *paper_plot_name(enum paper_plot plot)
{
	static const char *const names[PAPER_PLOTS] = {"paper-edges", "paper-maps"};
	return names[plot];
}

static void write_head(FILE *file, bool svg, const char *title, const char *x, const char *y)
{
	fprintf(file, "set terminal %s\n",
		svg ? "svg size 900,600 dynamic enhanced font 'sans-serif,14' background '#ffffff'"
		    : "pngcairo size 900,600 enhanced font 'sans-serif,11'");
	/* Room for the last number below the axis. */
	fprintf(file,
		"set rmargin 5\n"
		"set title '%s'\n"
		"set xlabel '%s'\n"
		"set ylabel '%s'\n"
		"set logscale xy\n"
		"set format x '%%.0s%%c'\n"
		"set format y '%%g'\n"
		"set grid xtics ytics lc '#dddddd' lt 1\n"
		"set border lc '#666666'\n"
		"set key top left reverse Left\n"
		"set datafile missing 'nan'\n",
		title, x, y);
}

static void write_meshes(FILE *file, const struct paper_result *result)
{
	fputs("$meshes << END\n", file);
	for (size_t i = 0; i < result->mesh_count; i++) {
		const struct paper_mesh *mesh = &result->meshes[i];
		/* Two empty lines set data sets apart. */
		if (i > 0 && strcmp(mesh->shape, mesh[-1].shape) != 0)
			fputs("\n\n", file);
		fprintf(file, "%llu %g %llu\n", (unsigned long long)mesh->edges, mesh->ms,
			(unsigned long long)mesh->silhouette_edges);
	}
	fputs("END\n$volokh << END\n", file);
	const struct volokh_mesh *volokh;
	for (size_t i = 0; (volokh = volokh_mesh(i)) != NULL; i++)
		fprintf(file, "%g %g\n", volokh->edges, volokh->ms);
	fputs("END\nplot", file);
	static const unsigned colors[] = {0x0072b2, 0xd55e00, 0x009e73};
	size_t set = 0;
	for (size_t i = 0; i < result->mesh_count; i++)
		if (i == 0 || strcmp(result->meshes[i].shape, result->meshes[i - 1].shape) != 0) {
			fprintf(file,
				" $meshes index %zu using 1:2 with linespoints lw 2 pt %zu ps 1.2 "
				"lc rgb '#%06x' title 'here: %s',",
				set, 5 + 2 * set, colors[set % 3], result->meshes[i].shape);
			set++;
		}
	fputs(" $volokh using 1:2 with linespoints lw 2 dt 2 pt 6 lc rgb '#666666' title "
	      "'Volokh (another machine)'\n",
		file);
}

static void write_sizes(FILE *file, const struct paper_result *result)
{
	fputs("$sizes << END\n", file);
	for (size_t i = 0; i < result->size_count; i++) {
		const struct paper_size *size = &result->sizes[i];
		fprintf(file, "%u %g %g\n", size->map, size->shadow_map,
			size->shadow_map + size->buffers);
	}
	fputs("END\n$volokh << END\n", file);
	const struct volokh_size *volokh;
	for (size_t i = 0; (volokh = volokh_size(i)) != NULL; i++)
		fprintf(file, "%g %g %g\n", volokh->map, volokh->shadow_map, volokh->with_buffers);
	fputs("END\n"
	      "set xrange [200:10500]\n"
	      "set format x '%.0f'\n"
	      "set xtics (256, 512, 1024, 2048, 4096, 8192)\n"
	      "plot $sizes using 1:2 with linespoints lw 2 pt 5 ps 1.2 lc rgb '#4c4c4c' title "
	      "'here: shadow map alone',"
	      " $sizes using 1:3 with linespoints lw 2 pt 7 ps 1.2 lc rgb '#d55e00' title "
	      "'here: shadow map and smoothie buffers',"
	      " $volokh using 1:2 with linespoints lw 2 dt 2 pt 4 lc rgb '#4c4c4c' title "
	      "'Volokh (a GPU): shadow map alone',"
	      " $volokh using 1:3 with linespoints lw 2 dt 2 pt 6 lc rgb '#d55e00' title "
	      "'Volokh: shadow map and smoothie buffers'\n",
		file);
}

void paper_plot_write(const struct paper_result *result, enum paper_plot plot, bool svg, FILE *file)
{
	switch (plot) {
	case PAPER_PLOT_MESHES:
		write_head(file, svg, "Time for silhouettes and fins", "edges", "milliseconds");
		write_meshes(file, result);
		break;
	case PAPER_PLOT_SIZES:
		write_head(file, svg, "Time to draw shadow map and smoothie buffers",
			"texels a side of the map", "milliseconds");
		write_sizes(file, result);
		break;
	case PAPER_PLOTS:
		break;
	}
}
