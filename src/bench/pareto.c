/* SPDX-License-Identifier: MIT */
#include "bench/pareto.h"

bool pareto_dominates(const double a[2], const double b[2])
{
	return a[0] <= b[0] && a[1] <= b[1] && (a[0] < b[0] || a[1] < b[1]);
}

static bool is_beaten(const double (*points)[2], size_t count, size_t i)
{
	for (size_t j = 0; j < count; j++) {
		bool equal = points[j][0] == points[i][0] && points[j][1] == points[i][1];
		if (pareto_dominates(points[j], points[i]) || (equal && j < i))
			return true;
	}
	return false;
}

size_t pareto_front(const double (*points)[2], size_t count, size_t *front)
{
	size_t found = 0;
	for (size_t i = 0; i < count; i++) {
		if (is_beaten(points, count, i))
			continue;
		size_t place = found++;
		for (; place > 0 && points[front[place - 1]][0] > points[i][0]; place--)
			front[place] = front[place - 1];
		front[place] = i;
	}
	return found;
}
