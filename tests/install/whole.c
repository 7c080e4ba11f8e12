/* SPDX-License-Identifier: MIT */
/* All parts of the program and the library linked whole: each name is defined once. */

int main(void)
{
	return 0;
}
