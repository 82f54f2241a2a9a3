/* ris.h: what methods have in common that draw by records: pcbdpt.c, ris.c, ris2.c. */
#ifndef ASBDPT_RIS_H
#define ASBDPT_RIS_H

#include "integrators/services.h"
#include "rivals/records.h"

struct ris;

struct ris_state {
    struct frozen frozen;
    int nabata;      /* weights: 0: counts of 1, 1: of N(s,c) */
    int presampled;  /* M2 of ris2, 0: one stage */
    int sub_paths;   /* M, of which light vertices are drawn; the others of the pool are for t = 1 alone */
    double records;  /* share of pixels */
    double vertices; /* l */
};

struct ris {
    struct light_pool pool; /* the first, see pooled.h */
    const struct ris_state *state;
    const struct scene *scene;
    int K;                   /* sub-paths that are drawn from: M, or all of a small pool */
    struct candidates found; /* [V] what is drawn from */
    double *u;               /* [V] the first stage's factors; NULL with one stage */
    double g, previous_g;    /* sum of L over these, over K, in this iteration and in the one before */
    struct records records, previous;
    struct arena arena;      /* of the first stage, and of the light sub-paths' L and n */
    double *light_L, *light_n; /* [pool.used] see ris.c; of these K */
    const struct mis_counts *counts;
    double own, all; /* n of the technique, and of all techniques of the strategy, that is being taken */
    struct sight *sight; /* [max_depth + 2] */
};

void ris_scratch_init(void *scratch, const void *state);
void ris_scratch_free(void *scratch);
void ris_prepare(const struct render_job *job, struct preparation *out);
void ris_begin(void *scratch, const void *state, const struct tile_pass *pass, long iteration);
void ris_draw(void *scratch, const void *state, struct pooled_pixel *pixel, const struct vertex *z, int t);

/* ris_hit, ris_lit, ris_joint: as connect_hit, connect_lit and connect_joint, with the weights of ris.c; ris_joint
 * takes r->own and r->all for n. */
struct connection ris_hit(struct ris *r, const struct vertex *prev, const struct vertex *z, int t);
struct connection ris_lit(struct ris *r, const struct lit *l);
struct connection ris_joint(struct ris *r, const struct joint *j);

/* ris_render: the `render` of ris and ris2. */
void ris_render(const struct preparation *m, const struct tile_pass *pass);

/* ris_worth: the sum of N of all techniques that join light vertex y of the pool to z. */
double ris_worth(const struct ris *r, const struct vertex *y, const struct vertex *z);

/* ris2_presample: the first stage: replace what was found by M2 draws in proportion to L. */
void ris2_presample(struct ris *r, const struct tile_pass *pass, long iteration);

extern const char *const RIS_WEIGHTS[];

/* RIS_SERVICES: of the tables of ris and ris2. */
#define RIS_SERVICES SERVICE_EMISSION(1), SERVICE_TILES(RECORDS_TILE, 1)

#endif
