/* plan.h: what an experiment consists of: scenes x variants x seeds, each rendered to a rising number of samples.
 *
 * A variant is an integrator with its parameters, without Russian roulette. The first five are compared everywhere;
 * the others move one parameter of `bins` at a time.                                       [S24 4] [S24 appendix A]
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_PLAN_H
#define ASBDPT_PLAN_H

#include <stdbool.h>

#include "base/file.h"
#include "scene/settings.h"

struct variant {
    const char *name;       /* in files and tables of numbers */
    const char *label;      /* for readers */
    const char *integrator; /* as method_find knows it */
    const char *select;     /* asbdpt's; NULL for bdpt */
    int bin_paths, restart; /* bins only, else 0 */
    bool quick;             /* part of a quick experiment */
    bool planned;           /* what it prepares depends on the samples of the whole picture */
};

enum {
    VARIANT_BDPT,
    VARIANT_BINS,
    VARIANT_POOL,
    VARIANT_VERTICES,
    VARIANT_SUBSPACES, /* the default of asbdpt */
    N_COMPARED,        /* the variants above are compared everywhere */
    N_VARIANTS = 11    /* the others are the sweeps over the parameters of bins */
};
extern const struct variant VARIANTS[N_VARIANTS];

/* The two sweeps: variants that differ in one parameter only, `bins` itself among them, by rising value. */
enum sweep { SWEEP_PATHS, SWEEP_RESTART, N_SWEEPS };
enum { SWEEP_LENGTH = 4 };
struct sweep_point {
    int variant;
    const char *label; /* what readers call it there */
};
extern const struct sweep_point SWEEPS[N_SWEEPS][SWEEP_LENGTH];

enum { PLAN_MAX_STEPS = 16, PLAN_MAX_SEEDS = 16 };

struct plan {
    const char **scene; /* [n_scenes] paths, borrowed */
    int n_scenes;
    bool quick;               /* which preset, which sweeps */
    long spp[PLAN_MAX_STEPS]; /* [n_steps] rising; errors are measured at each */
    int n_steps;
    int n_seeds;              /* repetitions of what is compared everywhere; the sweeps have one */
    int width, height;        /* width 0: the stored reference's; height 0: from the scene's aspect ratio */
    int max_depth;            /* 0: the stored reference's if the width is 0 too, else the scene's */
    long reference_spp;       /* of a reference made here */
    int n_threads;
    bool quiet;
    const char *directory; /* where everything is written */
    const char *reference; /* file or directory of stored references; NULL: ref/ beside the scene */
};

/* plan_preset: quick: at the size of the stored references, 8 to 64 spp, some of the sweeps; full: 320 pixels wide, 32
 * to 512 spp. */
void plan_preset(struct plan *p, bool quick);

/* plan_set_spp: measure at first, 2 first, 4 first ... up to `last`, which is always the last step. Returns false
 * with a message when that is too many steps. */
bool plan_set_spp(struct plan *p, long first, long last, struct error *err);

/* plan_last_step: the one after all samples. plan_last_spp: samples per pixel of the finished pictures. */
static inline int plan_last_step(const struct plan *p) { return p->n_steps - 1; }
static inline long plan_last_spp(const struct plan *p) { return p->spp[p->n_steps - 1]; }

/* plan_seeds: how often the plan renders a variant; 0 when it is left out. */
int plan_seeds(const struct plan *p, int variant);

/* plan_seed: the seed of repetition i = 1, 2, ... of a variant. Variants have seeds of their own, so that their
 * errors are independent. */
long plan_seed(int variant, int i);

/* plan_first_sample: where the render of step i begins: at the samples of step i - 1, whose film it continues, or
 * at 0 where that would not be the same as rendering in one go: bins must not be cut between two restarts, and
 * subspaces learns and chooses by the samples of the whole picture. */
long plan_first_sample(const struct plan *p, int variant, int i);

/* plan_run_spp: samples per pixel rendered for one run of a variant, over all steps. */
long plan_run_spp(const struct plan *p, int variant);

/* plan_create: begin to write a file of the plan's directory, as file_create does. */
bool plan_create(const struct plan *p, const char *name, struct file_output *out, struct error *err);

/* plan_command: write the command that carries the plan out again.
 *   how     its first options: of which kind, with how many samples
 *   margin  begins every line
 *   html    paths are escaped */
void plan_command(FILE *f, const struct plan *p, const char *how, const char *margin, bool html);

/* variant_settings: replace an integrator's settings by the variant's. */
void variant_settings(const struct variant *v, struct settings *out);

#endif
