/* ris.h: what methods have in common that draw by records: pcbdpt.c, ris.c, ris2.c. */
#ifndef ASBDPT_RIS_H
#define ASBDPT_RIS_H

#include "caustics/joint.h"
#include "rivals/records.h"

/* The `own` of these methods. */
struct ris {
    int nabata;     /* weights: 0: counts of 1, 1: of N(s,c) */
    int presampled; /* M2 of ris2, 0: one stage */
    int sub_paths;  /* M, of which light vertices are drawn; the others of the pool are for t = 1 alone */
    double records; /* share of pixels */
    double normals; /* see records_near */
};

struct cache {
    const struct scene *scene;
    const struct counts *counts;
    const struct ris *own;
    const struct pool *pool;
    int K, V;                      /* sub-paths that are drawn from: M, or all of a small pool; their vertices */
    const struct vertex *const *found; /* [V] what is drawn from */
    double *u;                     /* [V] the first stage's factors; NULL with one stage */
    double g;                      /* sum of L over these, over K */
    struct records records;

    /* What the weights of [Nabata 2020a] need. */
    struct arena arena[2];         /* of even and of odd iterations; owned */
    double vertices, credit;       /* l; of a draw */
    struct records previous;       /* of the iteration before */
    double previous_g;
    double *light_L, *light_n;     /* [pool->used] see ris.c; of these K */
    double one, all;               /* n of the technique, and of all techniques of the strategy, that is being taken */
    struct sight *sight;           /* [max_depth + 2] */
};

/* ris_prepare: what a draw counts as.
 * ris_render: the `render`, by the weights of ris.c or by counts; then by ris_build and ris_draw. */
void ris_prepare(const struct render_job *job, struct prepared *p);
void ris_render(const struct prepared *p, const struct tile_pass *pass);
struct cache *ris_build(const struct prepared *p, const struct tile_pass *pass, long iteration);
bool ris_draw(const struct prepared *p, const struct cache *r, struct sample *sample, const struct vertex *z,
              int i, int n, struct drawn *out);

/* With the weights of ris.c:
 *   ris_begin  an iteration: fill the pool. *r is all zeros before the first; ris_end releases it
 *   ris_join   add a draw for z = z_{t-1} */
void ris_begin(struct cache *r, const struct prepared *p, const struct tile_pass *pass, long iteration);
void ris_end(struct cache *r);
void ris_join(struct cache *r, struct sample *sample, const struct vertex *z, int t);

/* ris_hit, ris_lit, ris_joint: as connect_s0, connect_lit and connect_joint, with the weights of ris.c; ris_joint
 * takes r->one and r->all for n. */
struct connection ris_hit(struct cache *r, const struct vertex *prev, const struct vertex *z, int t);
struct connection ris_lit(struct cache *r, const struct lit *l);
struct connection ris_joint(struct cache *r, const struct joint *j);

/* ris_worth: the sum of N of all techniques that join light vertex y of the pool to z. */
double ris_worth(const struct cache *r, const struct vertex *y, const struct vertex *z);

/* ris2_presample: the first stage: replace what was found by M2 draws in proportion to L. */
void ris2_presample(struct cache *r, const struct tile_pass *pass, struct arena *arena, long iteration);

/* Rows of the tables of ris and ris2. */
extern const char *const RIS_WEIGHTS[];
extern const struct field RIS_PARAMETERS[];
#define RIS_WEIGHTS_FIELD                                                                                              \
    {"weights", FIELD_WORD, offsetof(struct ris, nabata), 1, 0, 0, "what draws count for", RIS_WEIGHTS}
#define RIS_SUBPATHS_FIELD(DEFAULT)                                                                                    \
    {"subpaths", FIELD_INTEGER, offsetof(struct ris, sub_paths), DEFAULT, 1, 1e6,                                      \
     "light sub-paths that are drawn from", NULL}
#define RIS_RECORDS_FIELD                                                                                              \
    {"records", FIELD_NUMBER, offsetof(struct ris, records), RECORDS_SHARE, 0, 1, "share of pixels that have records", \
     NULL}

#endif
