/* lessons.h: a round over sub-paths that fills tables. All threads trace sub-paths, in chunks. Each chunk makes a list
 * of lessons, and the lists are taken in in order (parallel.h). So sums and the numbers of regions are the same for any
 * number of threads.
 *
 * Tests: test_learning.c.
 */
#ifndef ASBDPT_LESSONS_H
#define ASBDPT_LESSONS_H

#include "transport/tile_pass.h"

struct learn_options; /* learn.h */

/* What a lesson is about, and the member of struct tables that it is for. */
enum lesson_kind {
    VISIT,       /* an eye vertex was there                           use */
    GUIDE,       /* what an eye vertex receives from a light cell     guide */
    TRIAL,       /* what an eye vertex receives from a light vertex   pairs */
    RAY,         /* what the ray of a light sub-path was worth        emission */
    LIGHT_VERTEX /* a light sub-path has a vertex there               vertices, light_vertices */
};

/* A sample for a table: its row and column, worth x and weight w (table.h). */
struct lesson {
    int kind;
    uint64_t row; /* a region, or the key of one that may be new */
    int column;   /* a region, light cell, or column of a ray */
    double x, w;
};

struct lessons {
    struct lesson *item; /* [n], owned */
    size_t n, capacity;
};

/* lessons_add: add it if w > 0 and x >= 0, and neither is so extreme that sums could overflow; else drop it. */
void lessons_add(struct lessons *list, struct lesson lesson);

enum { CHUNK = 256 }; /* number of sub-paths of a chunk */

struct learning {
    const struct render_job *job;
    struct workspace *work; /* [n_threads] */

    /* What learn.c knows so far. */
    const struct learn_options *options;
    struct tables *tables;
    struct axis rays;               /* columns of the table of emission */
    double n_light;                 /* light sub-paths so far */
    struct lessons light_vertices;  /* that these have */
    double budget, traced;          /* number of sub-paths: all that learning is by, and those so far */

    /* The round under way. */
    void (*trace)(struct learning *l, struct workspace *work, long i, struct lessons *out);
    void (*take)(struct learning *l, const struct lesson *lesson);
    struct counts counts; /* of any values, since no weight is used */
    long first, end;
    struct lessons *list; /* of the chunks under way */
};

/* lessons_learn: run a round over sub-paths first .. end-1, unless the job is cancelled. `trace` lists the lessons of
 * sub-path number i, whose vertices and lobes are in the workspace. l->take takes one in. Walks and connections use the
 * tables `known`, of which those that are being learnt count as empty. After each chunk it calls job->progress. */
void lessons_learn(struct learning *l, void (*trace)(struct learning *, struct workspace *, long, struct lessons *),
                   const struct tables *known, long first, long end);

#endif
