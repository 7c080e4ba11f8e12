/* SPDX-License-Identifier: MIT */
#include "truth.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#define SIZE_MOST 4096

/* The study's files: 65000 for full light, 65535 where not judged. */
static bool read_values(gzFile file, struct truth *truth)
{
	size_t count = (size_t)truth->width * truth->height;
	uint8_t *bytes = malloc(count * 2 + 1);
	truth->values = malloc(count * sizeof(*truth->values) + 1);
	bool read = bytes != NULL && truth->values != NULL &&
		    gzread(file, bytes, (unsigned int)(count * 2)) == (int)(count * 2);
	for (size_t i = 0; read && i < count; i++) {
		int value = bytes[2 * i] * 256 + bytes[2 * i + 1];
		truth->values[i] = value == 65535 ? NAN : (float)value / 65000.0f;
	}
	free(bytes);
	return read;
}

bool truth_read(struct truth *truth, const char *path)
{
	*truth = (struct truth){0};
	gzFile file = gzopen(path, "rb");
	if (file == NULL)
		return false;
	char magic[8], size[32], most[16];
	bool read = gzgets(file, magic, sizeof(magic)) != NULL && strcmp(magic, "P5\n") == 0 &&
		    gzgets(file, size, sizeof(size)) != NULL &&
		    sscanf(size, "%u %u", &truth->width, &truth->height) == 2 &&
		    truth->width <= SIZE_MOST && truth->height <= SIZE_MOST &&
		    gzgets(file, most, sizeof(most)) != NULL && strcmp(most, "65535\n") == 0 &&
		    read_values(file, truth);
	gzclose(file);
	if (!read)
		truth_finish(truth);
	return read;
}

void truth_finish(struct truth *truth)
{
	free(truth->values);
	*truth = (struct truth){0};
}

struct difference truth_compare(const struct truth *truth, const struct visibility *visibility)
{
	struct difference difference = {0};
	double penumbra = 0.0;
	for (size_t i = 0; i < (size_t)truth->width * truth->height; i++) {
		double v = truth->values[i], off = visibility->values[i] / 65535.0 - v;
		if (isnan(v))
			continue;
		if (v > 0.0 && v < 1.0) {
			penumbra += off * off;
			difference.penumbra_pixels++;
		} else {
			difference.outside_wrong += fabs(off) > 0.1;
		}
	}
	/* Without penumbra the sum is 0 too. */
	difference.penumbra_rmse = sqrt(penumbra / fmax(difference.penumbra_pixels, 1.0));
	return difference;
}
