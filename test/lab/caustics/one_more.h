/* one_more.h: a method and one strategy more, that joins eye vertices to light points in a way of its own.
 *
 * Paths that other strategies make as well have weights that it knows: it is asked for those of s <= 1 and t = 1.
 *
 * Tests: test_caustic.c, test_rival_parts.c.
 */
#ifndef ASBDPT_ONE_MORE_H
#define ASBDPT_ONE_MORE_H

#include "integrators/loop.h"

enum { ONE_MORE_MOST = 4 };

/* What it made of an eye sub-path's first t vertices. */
struct one_more_path {
    struct connection c;
    struct light_point y0;
    const struct vertex *passed; /* [n_passed] between the last of these and y0; in the sample's arena. Observers need
                                  * their places */
    int n_passed;
};

/* What describes such a strategy begins with this. */
struct one_more {
    /* What it makes of the eye sub-path's first t vertices; returns how many. */
    int (*connect)(const struct one_more *self, struct sample *sample, const struct vertex *eye, int t,
                   struct one_more_path out[ONE_MORE_MOST]);
    /* c->weight of a path that it makes, too: j has s <= 1 or t = 1, and c for its connection. NULL: it makes no such
     * paths.
     *   lens  t = 1: the point of the lens */
    void (*weigh)(const struct one_more *self, const struct sample *sample, const struct joined *j, vec3 lens,
                  struct connection *c);
};

/* one_more_sum_eye: s = 0 and s = 1 of an eye sub-path, and what is made in addition. */
void one_more_sum_eye(struct sample *sample, const struct one_more *more, int n);

/* one_more_render: selection_render with that strategy, by a method that is prepared. */
void one_more_render(const struct prepared *p, const struct one_more *more, const struct tile_pass *pass);

/* A method of this laboratory that is another with one strategy more; the `own` of its row begins with it. */
struct one_more_own {
    int with;                    /* parameter: number of ONE_MORE_METHODS */
    struct scene scene;          /* the render's, the other method's parameters being the usual ones */
    struct prepared method;      /* the other */
    const struct one_more *more; /* NULL: it would make nothing */
};
extern const char *const ONE_MORE_METHODS[];

/* For rows: one_more_prepare prepares the other method as if it were alone; its numbers and sizes become those of *p.
 * Then the row sets `more`. one_more_release gives the other method back. */
void one_more_prepare(const struct render_job *job, struct prepared *p);
void one_more_release(struct prepared *p);
void one_more_pass(const struct prepared *p, const struct tile_pass *pass);

#define ONE_MORE_WITH(own)                                                                                             \
    {"with", FIELD_WORD, offsetof(struct own, base.with), 0, 0, 0, "the method that has one strategy more",            \
     ONE_MORE_METHODS}

#endif
