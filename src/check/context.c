/* SPDX-License-Identifier: MIT */
#include "check/context.h"
#include "base/line.h"
#include "platform.h"
#include <stdlib.h>
#include <string.h>

static const struct {
	const char *name;
	const char *part; /* of GL_RENDERER */
	uint32_t size, map;
} classes[CHECK_CLASS_COUNT] = {
	/* zink names the Vulkan driver below it, which may be llvmpipe's: it is looked for first */
	[CHECK_ZINK] = {"zink", "zink", 256, 512},
	[CHECK_LLVMPIPE] = {"llvmpipe", "llvmpipe", 256, 512},
	/* 20 to 60 times slower than llvmpipe */
	[CHECK_SOFTPIPE] = {"softpipe", "softpipe", 128, 256},
	[CHECK_SWIFTSHADER] = {"swiftshader", "SwiftShader", 256, 512},
	[CHECK_HARDWARE] = {"hardware", "", 256, 512},
};

enum check_class check_class_find(const char *renderer)
{
	static const enum check_class order[] = {
		CHECK_ZINK, CHECK_LLVMPIPE, CHECK_SOFTPIPE, CHECK_SWIFTSHADER};
	for (size_t i = 0; i < sizeof(order) / sizeof(order[0]); i++)
		if (strstr(renderer, classes[order[i]].part) != NULL)
			return order[i];
	return CHECK_HARDWARE;
}

const char *check_class_name(enum check_class class)
{
	return classes[class].name;
}

uint32_t check_class_size(enum check_class class)
{
	return classes[class].size;
}

uint32_t check_class_map(enum check_class class)
{
	return classes[class].map;
}

void check_context_finish(struct check_context *context)
{
	free(context->drawn);
	free(context->wanted);
	platform_destroy(context->platform);
	*context = (struct check_context){0};
}

static void set(struct check_result *result, enum check_status status, const char *format,
	va_list args) __attribute__((format(printf, 3, 0)));

static void set(
	struct check_result *result, enum check_status status, const char *format, va_list args)
{
	result->status = status;
	line_format(result->message, sizeof(result->message), format, args);
}

void check_pass(struct check_result *result, const char *format, ...)
{
	va_list args;
	va_start(args, format);
	set(result, CHECK_PASS, format, args);
	va_end(args);
}

void check_fail(struct check_result *result, const char *format, ...)
{
	va_list args;
	va_start(args, format);
	set(result, CHECK_FAIL, format, args);
	va_end(args);
}

void check_skip(struct check_result *result, const char *format, ...)
{
	va_list args;
	va_start(args, format);
	set(result, CHECK_SKIP, format, args);
	va_end(args);
}

void check_compare(struct check_result *result, const uint16_t *drawn, const uint16_t *wanted,
	size_t count, double tolerance)
{
	struct check_difference *difference = &result->difference;
	double sum = 0;
	*difference = (struct check_difference){
		.pixels = count, .budget = difference->budget, .tolerance = tolerance};
	for (size_t i = 0; i < count; i++) {
		double off = abs((int)drawn[i] - (int)wanted[i]) / 65535.0;
		sum += off;
		difference->failing += off > tolerance;
		difference->max = off > difference->max ? off : difference->max;
	}
	difference->mean = sum / (double)count;
}
