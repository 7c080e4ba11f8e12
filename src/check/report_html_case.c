/* SPDX-License-Identifier: MIT */
#include "bench/difference.h"
#include "check/report_page.h"
#include "page/escape.h"
#include "page/page.h"
#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

bool page_has_case(const struct check_result *result)
{
	return result->status != CHECK_PASS && result->status != CHECK_SKIP;
}

const char *page_class(enum check_status status)
{
	static const char *const classes[CHECK_STATUS_COUNT] = {
		[CHECK_PASS] = "good",
		[CHECK_FAIL] = "bad",
		[CHECK_SKIP] = "idle",
		[CHECK_CRASH] = "bad",
		[CHECK_TIMEOUT] = "bad",
		[CHECK_FLAKE] = "odd",
		[CHECK_EXPECTED_FAIL] = "odd",
		[CHECK_UNEXPECTED_PASS] = "bad",
	};
	return classes[status];
}

void page_print_status(enum check_status status, FILE *file)
{
	fprintf(file, "<span class=\"tag %s\">%s</span>", page_class(status),
		check_status_name(status));
}

/* A PNG file that is to be shown. */
struct image {
	uint8_t *bytes; /* owned; NULL: there is none */
	size_t size;
	uint32_t width, height;
};

/* Larger ones are none that check_pictures_write() made. */
#define IMAGE_BYTES_MAX ((size_t)64 << 20)

static void read_bytes(struct image *image, FILE *file)
{
	long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
	if (size < 0 || (size_t)size > IMAGE_BYTES_MAX || fseek(file, 0, SEEK_SET) != 0)
		return;
	image->bytes = malloc((size_t)size + 1);
	if (image->bytes != NULL)
		image->size = fread(image->bytes, 1, (size_t)size, file);
}

static uint32_t read_number(const uint8_t bytes[4])
{
	return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 |
	       bytes[3];
}

static void image_finish(struct image *image)
{
	free(image->bytes);
	*image = (struct image){0};
}

/* PNG, sections 5.2 and 11.2.2: the signature, and the size in the first chunk. */
static bool image_init(struct image *image, const char *folder, const char *name)
{
	static const uint8_t start[16] = "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR";
	char path[PATH_MAX];
	*image = (struct image){0};
	if (name[0] == '\0' || !check_report_path(folder, name, path, NULL))
		return false;
	FILE *file = fopen(path, "re");
	if (file == NULL)
		return false;
	read_bytes(image, file);
	fclose(file);
	if (image->size < 24 || memcmp(image->bytes, start, sizeof(start)) != 0) {
		image_finish(image);
		return false;
	}
	image->width = read_number(&image->bytes[16]);
	image->height = read_number(&image->bytes[20]);
	return true;
}

static void print_image(const struct image *image, const char *class, const char *what,
	const char *name, FILE *file)
{
	fprintf(file, "<img class=\"%s\" width=\"%" PRIu32 "\" height=\"%" PRIu32 "\" alt=\"%s of ",
		class, image->width, image->height, what);
	escape_markup(name, file);
	fputs("\" src=\"", file);
	page_data_uri("image/png", image->bytes, image->size, file);
	fputs("\">", file);
}

static void print_wipe(
	const struct image *result, const struct image *reference, const char *name, FILE *file)
{
	fputs("<figure><div class=\"stage\">", file);
	print_image(reference, "under", "Reference", name, file);
	print_image(result, "over", "Result", name, file);
	fputs("<i></i><input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"Wipe: "
	      "share of the picture that shows the result of ",
		file);
	escape_markup(name, file);
	fputs("\" aria-valuetext=\"50 % result\"></div>\n<figcaption><span>&#9664; result</span>"
	      "<span>reference &#9654;</span></figcaption></figure>\n",
		file);
}

static void print_heat(
	const struct image *difference, const struct check_result *result, FILE *file)
{
	double full = check_difference_full(result->difference.max);
	fputs("<figure>", file);
	print_image(difference, "heat", "Difference", result->name, file);
	fprintf(file,
		"<figcaption><span>result less reference</span><span class=\"scale\">&minus;%g "
		"too dark<i></i>too bright +%g</span></figcaption></figure>\n",
		full, full);
}

static void print_pictures(const char *folder, const struct check_result *result, FILE *file)
{
	struct image of_result, reference, difference;
	if (result->pictures.result[0] == '\0')
		return;
	bool wipe = image_init(&of_result, folder, result->pictures.result);
	wipe = image_init(&reference, folder, result->pictures.reference) && wipe;
	bool heat = image_init(&difference, folder, result->pictures.difference);
	fputs("<div class=\"pictures\">\n", file);
	if (wipe)
		print_wipe(&of_result, &reference, result->name, file);
	if (heat)
		print_heat(&difference, result, file);
	fputs("</div>\n", file);
	if (!wipe || !heat)
		fputs("<p class=\"soft\">Pictures are missing from the folder.</p>\n", file);
	image_finish(&of_result);
	image_finish(&reference);
	image_finish(&difference);
}

static void print_numbers(const struct check_result *result, FILE *file)
{
	const struct check_difference *difference = &result->difference;
	fputs("<p class=\"soft\">", file);
	if (difference->pixels > 0)
		fprintf(file,
			"%" PRIu64 " of %" PRIu64 " pixels differ by more than %g (%" PRIu64
			" may); mean %.3g, largest %.3g; ",
			difference->failing, difference->pixels, difference->tolerance,
			difference->budget, difference->mean, difference->max);
	fprintf(file, "%" PRIu32 " attempt%s, %.2f s", result->attempts,
		result->attempts == 1 ? "" : "s", result->seconds);
	if (result->first_status != result->status)
		fprintf(file, ", at first %s", check_status_name(result->first_status));
	fputs("</p>\n", file);
}

void page_print_case(const struct check_report *report, size_t index, FILE *file)
{
	const struct check_result *result = &report->run->results[index];
	fprintf(file, "<article class=\"case\" id=\"case-%zu\">\n<h3>", index);
	page_print_status(result->status, file);
	fputs(" <code>", file);
	escape_markup(result->name, file);
	fputs("</code></h3>\n", file);
	if (result->message[0] != '\0') {
		fputs("<p>", file);
		escape_markup(result->message, file);
		fputs("</p>\n", file);
	}
	print_numbers(result, file);
	print_pictures(report->folder, result, file);
	fputs("</article>\n", file);
}
