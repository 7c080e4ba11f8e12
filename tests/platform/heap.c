/* SPDX-License-Identifier: MIT */
#include "heap.h"
#include "platform.h"
#include <GLES3/gl3.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define BLOCK ((size_t)64 << 10)
#define BLOCKS 256 /* 16 MiB in all: far more than what is kept else */

/* Takes and frees a frame's worth of memory. Returns by how much the heap ends lower than it was at
 * its highest. */
static ptrdiff_t give_back(void)
{
	static void *blocks[BLOCKS];
	for (size_t i = 0; i < BLOCKS; i++) {
		blocks[i] = malloc(BLOCK);
		assert_non_null(blocks[i]);
	}
	char *highest = sbrk(0);
	for (size_t i = BLOCKS; i-- > 0;)
		free(blocks[i]);
	return highest - (char *)sbrk(0);
}

/* What is freed is kept once a driver that draws on the processor is there. */
static void what_a_frame_frees_is_kept(void **state)
{
	(void)state;
	struct sm_error error;
	if (give_back() < (ptrdiff_t)(BLOCK * BLOCKS / 2)) {
		print_message("the heap is not glibc's: skipped\n");
		skip();
	}
	struct platform *platform = platform_create("surfaceless", false, &error);
	if (platform == NULL)
		fail_msg("%s", error.text);
	assert_non_null(strstr((const char *)glGetString(GL_RENDERER), "llvmpipe"));
	assert_true(HEAP_KEPT > BLOCK * BLOCKS);
	give_back();
	assert_int_equal(give_back(), 0);
	platform_destroy(platform);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_a_frame_frees_is_kept),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
