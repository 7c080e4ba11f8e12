/* SPDX-License-Identifier: MIT */
#include "bench/paper_volokh.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

const struct volokh_mesh *volokh_mesh(size_t i)
{
	static const struct volokh_mesh meshes[] = {{721, .25}, {2977, .75}, {6769, 1.5},
		{12097, 2.5}, {18961, 3.7}, {48769, 9.5}, {67051, 14.5}, {96661, 21}, {131671, 29},
		{195841, 41}};
	return i < COUNT(meshes) ? &meshes[i] : NULL;
}

const struct volokh_size *volokh_size(size_t i)
{
	static const struct volokh_size sizes[] = {{512, 1.3, 1.35}, {1024, 1.8, 1.5},
		{2048, 2.5, 2.4}, {4096, 3.8, 5.4}, {6144, 5.5, 10.8}, {8192, 10.2, 18.1}};
	return i < COUNT(sizes) ? &sizes[i] : NULL;
}
