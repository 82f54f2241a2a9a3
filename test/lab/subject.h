/* subject.h: a scene of a plan under measurement: how its methods render it, and what results of that depend on.
 *
 * Tests: test_report.c, test_equal_time.c.
 */
#ifndef ASBDPT_LAB_SUBJECT_H
#define ASBDPT_LAB_SUBJECT_H

#include "lab/results.h"
#include "lab/store.h"

struct subject {
    const struct plan *plan;
    struct scene scene;
    struct scene_results *out;
    unsigned long probe[METHODS_MAX]; /* what the program makes of the scene; 0: not asked yet */
    float *picture[METHODS_MAX][PLAN_MAX_STEPS][PLAN_MAX_SEEDS]; /* of the reference's size; owned; NULL: not kept */
    struct pace *pace; /* see measure.c */
    struct error *err;
};

/* subject_options: how a method is rendered; the scene's settings become the method's. */
struct render_job subject_options(struct subject *s, const struct measured *m, uint64_t seed, int n_threads);

/* subject_probe: checksum of a small picture of one sample per pixel by a method of the plan: it changes when the
 * scene, its files or the program do, so that what is kept of another scene or version is not taken for this one's. 0
 * when it cannot be rendered. */
unsigned long subject_probe(struct subject *s, int method);

/* subject_key: all that a method's measurements depend on but seed and samples, at the beginning of a key; returns its
 * length. */
int subject_key(struct subject *s, int method, char key[STORE_KEY]);

/* subject_price: s->out->price of a method with a seed, from 1 on, read from the store or measured. False with a
 * message. */
bool subject_price(struct subject *s, int method, int seed);

#endif
