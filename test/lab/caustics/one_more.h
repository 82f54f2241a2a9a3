/* one_more.h: a method and one strategy more, that joins eye vertices to light points in a way of its own.
 *
 * Paths that other strategies make as well have weights that it knows: it is asked for those of s <= 1 and t = 1.
 *
 * Tests: test_caustic.c, test_ellipse.c.
 */
#ifndef ASBDPT_ONE_MORE_H
#define ASBDPT_ONE_MORE_H

#include "integrators/pooled.h"

enum { ONE_MORE_MOST = 4 };

/* What it made of an eye sub-path's first t vertices. */
struct one_more_path {
    struct connection c;
    int passed; /* vertices between the last of these and the light's point */
};

/* What describes such a strategy begins with this. */
struct one_more {
    /* What it makes of the eye sub-path's first t vertices; returns how many. The arena is for what does not outlive
     * the sample. */
    int (*connect)(const struct one_more *self, struct pixel_sample *sample, struct arena *arena,
                   const struct vertex *eye, int t, struct one_more_path out[ONE_MORE_MOST]);
    /* c->weight of a path that it makes, too: by s <= 1 from t eye vertices, or by t = 1 from s light vertices. NULL:
     * it makes no such paths. */
    void (*weigh)(const struct one_more *self, const struct pixel_sample *sample, struct arena *arena,
                  const struct vertex *path, int s, int t, struct connection *c);
};

/* one_more_sum_eye: as pixel_sum_eye, s = 0 and s = 1, and what is made in addition. */
void one_more_sum_eye(struct pixel_sample *sample, struct arena *arena, const struct one_more *more,
                      const struct vertex *eye, int n);

/* one_more_render: a tile pass by a method that is prepared, with that strategy.
 *   method  pt, bdpt, or one that shares the light sub-paths of a tile (pooled.h), whose scratch the workspace holds */
void one_more_render(const struct preparation *method, const struct one_more *more, const struct tile_pass *pass);

/* A method of this laboratory that is another with one strategy more; the state of its row begins with it. */
struct one_more_state {
    struct frozen frozen;      /* not used */
    int with;                  /* parameter: number of ONE_MORE_METHODS */
    struct scene scene;        /* the render's, the other method's parameters being the usual ones */
    struct preparation method; /* the other */
    const struct one_more *more; /* NULL: it would make nothing */
};
extern const char *const ONE_MORE_METHODS[];

/* one_more_counts: those of the other method. */
const struct mis_counts *one_more_counts(const struct one_more_state *s);

/* For rows: one_more_prepare prepares the other method as if it were alone; its numbers and sizes become those of
 * `out`. Then the row sets `more`. one_more_release gives the other method back. */
void one_more_prepare(const struct render_job *job, struct preparation *out);
void one_more_release(void *state);
void one_more_pass(const struct preparation *m, const struct tile_pass *pass);
void one_more_scratch(void *scratch, const void *state);
void one_more_scratch_free(void *scratch);
struct one_more_scratch {
    const struct preparation *method;
    void *own; /* the other method's */
};

#define ONE_MORE_WITH(state)                                                                                           \
    {"with", FIELD_WORD, offsetof(struct state, base.with), 0, 0, 0, "the method that has one strategy more",          \
     ONE_MORE_METHODS}
#define ONE_MORE_ROW                                                                                                   \
    .rr_threshold = DEFAULT_RR_THRESHOLD, .scratch_size = sizeof(struct one_more_scratch),                             \
    .render = one_more_pass, .scratch_init = one_more_scratch, .scratch_free = one_more_scratch_free

#endif
