/* SPDX-License-Identifier: MIT */
#ifndef BENCH_PAPER_CLAIM_H
#define BENCH_PAPER_CLAIM_H

#include "bench/paper_result.h"

enum verdict { VERDICT_HOLDS, VERDICT_PARTLY, VERDICT_FAILS, VERDICT_UNMEASURED };

/** "holds", "in part", "does not hold", "not measured". */
const char *verdict_name(enum verdict verdict);

#define PAPER_EVIDENCE_MAX 320

/** Something that a paper says, and what is found of it here. */
struct paper_claim {
	const char *source, *text;
	enum verdict verdict;
	char evidence[PAPER_EVIDENCE_MAX]; /* our numbers, and by which of them it is judged */
};

#define PAPER_CLAIMS_MAX 24

/** Judges every claim by the numbers of the result; returns how many there are. */
size_t paper_claims_judge(
	const struct paper_result *result, struct paper_claim claims[PAPER_CLAIMS_MAX]);

#endif
