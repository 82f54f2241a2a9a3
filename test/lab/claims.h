/* claims.h: what the papers claim of their methods, and whether it is so here: verdicts that are computed.
 *
 * A claim says that the squared error of a method is below so much of another's, after the same CPU time or the same
 * samples, as its paper has it, in all scenes or in those of a name. It is
 *     found        if the 95 % interval of the ratio (equal_mean) lies below, by mse8, by relmse and by 8x8,
 *     not found    if one of the three lies above,
 *     cannot tell  otherwise,
 *     not judged   where what is here is not the paper's method; the ratio is shown all the same.
 * Three intervals are looked at and all must agree, so of claims that are only as good as their number at most one in
 * forty is found. The table has how many that would be of all that are judged. [Popov 2015] makes no claim here: its
 * bound of the variance is missing.
 *
 * Tests: test_equal_time.c.
 */
#ifndef ASBDPT_LAB_CLAIMS_H
#define ASBDPT_LAB_CLAIMS_H

#include "lab/equal.h"

struct claim {
    const char *method, *over; /* as methods_all names them */
    double below;
    enum basis at;
    bool alone;        /* judged by the choice alone whatever half is asked for: its services are not all built */
    const char *where; /* scenes whose names begin so; NULL: all */
    const char *lacks; /* why it is not judged; NULL: it is */
    const char *text;  /* what is claimed, and by whom */
};

enum verdict_of { CLAIM_FOUND, CLAIM_NOT_FOUND, CLAIM_OPEN, CLAIM_NOT_JUDGED, CLAIM_UNMEASURED };

/* claim_judge: one claim, in one half of the family (methods.h).
 *   ratio  out: by mse8, relmse, 8x8;  n  out: scenes
 * CLAIM_UNMEASURED where a method or a scene is not among the results. */
enum verdict_of claim_judge(const struct results *r, const struct claim *c, enum half half,
                            struct interval ratio[N_SQUARES], int *n);

/* claims_table: all claims that were measured, as Markdown: criterion, numbers, verdict. */
void claims_table(FILE *f, const struct results *r, enum half half);

#endif
