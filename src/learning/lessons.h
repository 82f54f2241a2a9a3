/* lessons.h: a pass over sub-paths that fills tables. All threads trace sub-paths, in chunks. Each chunk makes a list
 * of lessons, and the lists are taken in in order (parallel.h). So sums and the numbers of regions are the same for any
 * number of threads.
 *
 * Tests: test_learning.c.
 */
#ifndef ASBDPT_LESSONS_H
#define ASBDPT_LESSONS_H

#include "transport/tile_pass.h"

struct learn_options; /* learn.h */

/* A sample for a table: its row and column, worth and weight. */
struct lesson {
    uint64_t row; /* a region, or the key of one that may be new */
    int column;
    double x, w;
};

struct lessons {
    struct lesson *item; /* [n], owned */
    size_t n, capacity;
};

/* lessons_add: add it if w > 0 and x >= 0, and neither is so extreme that sums could overflow; else drop it. */
void lessons_add(struct lessons *list, struct lesson lesson);

/* What learning knows so far. */
struct learning {
    const struct render_job *job;
    const struct learn_options *options;
    struct tables *tables;
    struct table_sums direct, sums; /* of the table of direct light; of the pass under way */
    struct axis columns;
    double n_light;          /* light sub-paths so far */
    struct lessons light_vertices; /* that these have */
    struct workspace *work;  /* [n_threads] */
    double budget, traced;   /* number of sub-paths: all that learning is by, and those so far */
};

enum { CHUNK = 256 }; /* number of sub-paths of a chunk */

struct pass {
    /* List the lessons of sub-path number i, whose vertices and lobes are in the workspace. */
    void (*trace)(struct learning *l, const struct counts *counts, struct workspace *work, long i,
                  struct lessons *out);
    void (*take)(struct learning *l, const struct lesson *lesson);
    struct tables known; /* that walks and connections use; they do not change meanwhile */
};

/* lessons_learn: run a pass over sub-paths first .. end-1, unless the job is cancelled. After each chunk
 * job->progress hears of it. */
void lessons_learn(struct learning *l, const struct pass *pass, long first, long end);

#endif
