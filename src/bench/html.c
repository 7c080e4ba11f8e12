/* SPDX-License-Identifier: MIT */
#include "bench/html.h"
#include "bench/column.h"
#include "bench/difference.h"
#include "bench/frontier.h"
#include "bench/mean.h"
#include "page/escape.h"
#include "page/page.h"

/* What only these pages have; colours of difference pictures follow as stops of a gradient. */
static const char style[] =
	":root{--best:#e3f4e8}\n"
	"@media(prefers-color-scheme:dark){:root{--best:#1d3a28}\n"
	"img.plot{filter:invert(.92) hue-rotate(180deg)}}\n"
	"img.plot{min-width:36rem}\n"
	"td.best{background:var(--best)}\n"
	".bars{width:100%;max-width:46rem}.bars td:nth-child(2){width:100%;padding:.2rem 0}\n"
	".bars th,.bars td{border:0}.bar{display:flex;height:.9rem}\n"
	".legend span{margin-right:1rem;white-space:nowrap;font-size:.875rem}"
	".legend i{display:inline-block;width:.8rem;height:.8rem;margin-right:.35rem;"
	"vertical-align:-.05rem}\n"
	".p0{background:#4c78a8}.p1{background:#e08a3c}.p2{background:#4f9e77}.p3{background:"
	"#b65b8a}.p4{background:#8c7bc4}.p5{background:#a8883a}.p6{background:#3f9fb0}"
	".p7{background:#8a8f98}\n"
	".differences{display:grid;gap:.75rem;"
	"grid-template-columns:repeat(auto-fill,minmax(min(100%,26rem),1fr))}\n"
	".scale i{background:";

void html_write_plot(const struct contents *contents, const struct result *setting,
	const struct result *scene, FILE *file)
{
	char svg[FILE_NAME_MAX], png[FILE_NAME_MAX];
	if (!has_plot(contents, setting, scene))
		return;
	plot_file_name(contents, setting, scene, "svg", svg);
	plot_file_name(contents, setting, scene, "png", png);
	fprintf(file,
		"<figure><img class=\"plot\" src=\"%s\" width=\"900\" height=\"600\" alt=\"Error "
		"in penumbrae against time of a frame, by technique; the table tells the "
		"numbers\"><figcaption>The line joins what nothing else beats in both. "
		"<a href=\"%s\">PNG</a></figcaption></figure>\n",
		svg, png);
}

static void write_style(FILE *file)
{
	fprintf(file, "<style>\n%s", style);
	difference_write_gradient(file);
	fputs("}\n</style>\n", file);
}

static void write_means(const struct contents *contents, const struct result *setting, FILE *file)
{
	const struct mean_column *column;
	char text[160];
	setting_describe(setting, text, sizeof(text));
	fputs("<div class=\"scroll\"><table>\n<caption>Means over scenes; ", file);
	escape_markup(text, file);
	fputs("</caption>\n<thead><tr><th scope=\"col\">technique</th><th "
	      "scope=\"col\">scenes</th>",
		file);
	for (size_t i = 0; (column = mean_column_at(i)) != NULL; i++)
		fprintf(file, "<th scope=\"col\">%s</th>", column->heading);
	fputs("</tr></thead>\n<tbody>\n", file);
	for (size_t i = 0; i < contents->techniques.count; i++) {
		const struct result *technique = contents->techniques.items[i];
		struct mean mean = mean_of(contents->results, setting, technique, NULL);
		if (mean.scenes == 0)
			continue;
		fputs("<tr><th scope=\"row\">", file);
		escape_markup(technique->technique, file);
		fprintf(file, "</th><td>%zu</td>", mean.scenes);
		for (size_t j = 0; (column = mean_column_at(j)) != NULL; j++) {
			fputs("<td>", file);
			mean_write(column, &mean, file);
			fputs("</td>", file);
		}
		fputs("</tr>\n", file);
	}
	fputs("</tbody></table></div>\n", file);
}

static void write_overview(const struct contents *contents, FILE *file)
{
	html_write_plot(contents, contents->main, NULL, file);
	write_means(contents, contents->main, file);
	fputs("<p>", file);
	frontier_write_alone(contents, escape_markup, file);
	fputs("</p>\n<p class=\"soft\">Errors are of visibility, linear from 0 to 1, against a "
	      "ray-traced "
	      "reference, in pixels that see a part of the light. Times are geometric means; of "
	      "everything else less is better, but for bias, which is best at 0 and above it too "
	      "bright.</p>\n",
		file);
	for (size_t i = 0; i < contents->settings.count; i++) {
		const struct result *setting = contents->settings.items[i];
		char text[160];
		if (setting == contents->main)
			continue;
		setting_describe(setting, text, sizeof(text));
		fputs("<details><summary>", file);
		escape_markup(text, file);
		fputs("</summary>\n", file);
		html_write_plot(contents, setting, NULL, file);
		write_means(contents, setting, file);
		fputs("</details>\n", file);
	}
}

static void write_scenes(const struct contents *contents, FILE *file)
{
	fputs("<h2 id=\"scenes\">Scenes</h2>\n<nav><p>", file);
	for (size_t i = 0; i < contents->scenes.count; i++) {
		fprintf(file, "%s<a href=\"#scene-%zu\">", i > 0 ? " &middot; " : "", i);
		escape_markup(contents->scenes.items[i]->scene, file);
		fputs("</a>", file);
	}
	fputs("</p></nav>\n<p class=\"soft\">The best of each column is marked.</p>\n", file);
	for (size_t i = 0; i < contents->scenes.count; i++)
		html_write_scene(contents, contents->scenes.items[i], file);
}

static void write_facts(const struct run_facts *facts, FILE *file)
{
	fputs("<h2 id=\"repeat\">How to repeat it</h2>\n<p>At commit <code>", file);
	escape_markup(run_facts_get(facts, "commit"), file);
	fputs("</code>:</p>\n<div class=\"scroll\"><pre><code>", file);
	escape_markup(run_facts_get(facts, "command"), file);
	fputs("</code></pre></div>\n<h2 id=\"machine\">Machine, driver, settings</h2>\n"
	      "<div class=\"scroll\"><table><tbody>\n",
		file);
	for (size_t i = 0; i < facts->count; i++)
		page_pair(facts->items[i].key, facts->items[i].value, file);
	fputs("</tbody></table></div>\n", file);
}

static void write_columns(FILE *file)
{
	fputs("<details><summary>Columns of results.csv</summary>\n<div class=\"scroll\"><table>"
	      "<tbody>\n",
		file);
	for (size_t i = 0; column_at(i) != NULL; i++)
		page_pair(column_at(i)->name, column_at(i)->help, file);
	fputs("</tbody></table></div></details>\n", file);
}

void html_write(const struct contents *contents, FILE *file)
{
	page_begin("smoothie bench", file);
	write_style(file);
	page_body(file);
	fputs("<h1>Soft shadows: error against time</h1>\n<p class=\"soft\">", file);
	escape_markup(run_facts_get(contents->facts, "date"), file);
	fprintf(file,
		"; techniques: %zu, scenes: %zu, results: %zu, as <a href=\"results.csv\">CSV</a> "
		"and <a href=\"results.json\">JSON</a></p>\n",
		contents->techniques.count, contents->scenes.count, contents->results->count);
	if (contents->main != NULL) {
		fputs("<p class=\"soft\">", file);
		escape_markup(contents->main->machine, file);
		fputs("</p>\n", file);
		write_overview(contents, file);
		write_scenes(contents, file);
	} else {
		fputs("<p>Nothing was measured.</p>\n", file);
	}
	write_facts(contents->facts, file);
	write_columns(file);
	page_end(file);
}
