/* plan.h: what an experiment consists of: scenes x methods x seeds, each rendered to a rising number of samples.
 *
 * The first methods are compared everywhere, with the first of them; the others belong to sweeps, which move one
 * parameter.                                                                               [S24 4] [S24 appendix A]
 *
 * Tests: test_plan.c.
 */
#ifndef ASBDPT_PLAN_H
#define ASBDPT_PLAN_H

#include "base/file.h"
#include "lab/methods.h"

enum { PLAN_MAX_STEPS = 16, PLAN_MAX_SEEDS = 16 };

struct plan {
    const char **scene; /* [n_scenes] paths, borrowed */
    int n_scenes;
    struct methods methods;
    int n_compared; /* of these; the others are in sweeps alone */
    long spp[PLAN_MAX_STEPS]; /* [n_steps] rising; errors are measured at each */
    int n_steps;
    bool equal;               /* these are the first method's samples; the others are given its time, see equal.h */
    double seconds;           /* of CPU, that all are given; 0: what the first takes for its samples */
    bool no_roulette;         /* no walk is ended by Russian roulette, unless a method says otherwise */
    int n_seeds;              /* repetitions of what is compared; what is in sweeps alone has one */
    int width, height;        /* width 0: see plan_scene_load; height 0: from the scene's aspect ratio */
    int max_depth;            /* 0: the stored reference's if the width is 0 too, else the scene's */
    uint64_t seed;            /* 0, or another set of random numbers */
    int reference_spp;        /* of a reference made here */
    int n_threads;
    bool quiet;
    const char *directory; /* where everything is written */
    const char *reference; /* file or directory of stored references; NULL: ref/ next to the scene */
    const char *command;   /* that carries it out again, without -o and scenes */
};

/* plan_set_spp: measure at first, 2 first, 4 first ... up to `last`, which is always the last step. Returns false
 * with a message when that is too many steps. */
bool plan_set_spp(struct plan *p, long first, long last, struct error *err);

/* plan_set_methods: what is compared, a list as methods_read takes it. plan_add_sweep: another list; what is compared
 * already is not measured twice. False with a message. */
bool plan_set_methods(struct plan *p, const char *list, struct error *err);
bool plan_add_sweep(struct plan *p, const char *list, struct error *err);

/* plan_last_step: the one after all samples. plan_last_spp: samples per pixel of the finished pictures. */
static inline int plan_last_step(const struct plan *p) { return p->n_steps - 1; }
static inline long plan_last_spp(const struct plan *p) { return p->spp[p->n_steps - 1]; }

/* plan_seeds: how often the plan renders a method. plan_seed: the seed of repetition i = 1, 2, ... Methods have seeds
 * of their own, so that their errors are independent, whatever else is measured. */
int plan_seeds(const struct plan *p, int method);
uint64_t plan_seed(const struct plan *p, int method, int i);

/* plan_create: begin to write a file of the plan's directory, as file_create does. */
bool plan_create(const struct plan *p, const char *name, struct file_output *out, struct error *err);

/* plan_write_command: the command that carries the plan out again, as Markdown. */
void plan_write_command(FILE *f, const struct plan *p);

#endif
