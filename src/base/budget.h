/* budget.h: how much memory the files of a job may take. It is asked before anything is allocated whose size a file
 * says.
 *
 * Tests: parser_limits.c, test_image.c, test/cli.sh. */
#ifndef ASBDPT_BUDGET_H
#define ASBDPT_BUDGET_H

#include "base/error.h"

struct budget {
    double limit, taken; /* bytes */
    const char *advice;  /* for messages: how to raise the limit */
};

/* budget_new: of so many bytes; 0: of three quarters of the machine's memory, or of 4 GB where nobody knows that. */
struct budget budget_new(double limit, const char *advice);

/* budget_has: are so many bytes left? budget_take: take them. False with a message of how many were asked for. */
bool budget_has(const struct budget *b, double bytes, struct error *err);
bool budget_take(struct budget *b, double bytes, struct error *err);

#endif
