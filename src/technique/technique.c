/* SPDX-License-Identifier: MIT */
#include "technique/technique.h"
#include <string.h>

static const struct technique *const techniques[] = {
	&technique_auto,
	&technique_smoothie,
	&technique_smoothie_two_sided,
	&technique_penumbra_map,
	&technique_hard,
	&technique_pcf,
	&technique_pcss,
	&technique_vsm,
	&technique_maps,
	&technique_gather,
};

const struct technique *technique_at(size_t index)
{
	return index < sizeof(techniques) / sizeof(techniques[0]) ? techniques[index] : NULL;
}

const struct technique *technique_find(const char *name)
{
	const struct technique *technique;
	for (size_t i = 0; (technique = technique_at(i)) != NULL; i++)
		if (strcmp(technique->name, name) == 0)
			break;
	return technique;
}
