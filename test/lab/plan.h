/* plan.h: what an experiment consists of: scenes x methods x seeds, each rendered to a rising number of samples; its
 * scenes as they are rendered, and their stored references.
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
#include "lab/reference.h"
#include "scene/scene.h"

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

/* plan_scene_name: the file's name without .pbrt; for .../NAME/scene.pbrt the directory's. At most size - 1
 * bytes. */
enum { PLAN_NAME = 60 }; /* with two methods it names files, whose names have 255 bytes at most */
void plan_scene_name(const char *path, char *out, int size);

/* plan_scene_read: read a scene as experiments render it, whole and with a box filter, and prepare it.
 *   width      0: the film's own, or WIDTH_WITHOUT_REFERENCE if that is less
 *   height     0: by the scene's aspect ratio
 *   max_depth  0: the scene's; *depth is the one in force
 * Returns false with a message, then nothing needs release. */
enum { WIDTH_WITHOUT_REFERENCE = 160, WIDTH_TO_SEE = 96 };
bool plan_scene_read(const char *path, int width, int height, int max_depth, struct scene *scene, int *depth,
                     struct error *err);

/* plan_scene_load: the same at the plan's size and depth, with its stored reference. Where the plan leaves the width
 * open, size and depth are the reference's; without one the width is 0, with a warning. What is found next to the scene
 * is taken only if it says that it is of this scene, size and depth; if it is narrower than WIDTH_TO_SEE and the plan
 * leaves the width open, pictures are that wide, without a reference.
 *   name    what the reference is called
 *   stored  out, to be given to reference_free; its pixels are NULL where there is none, or none that fits
 * Returns false with a message, also when a reference was given that cannot be used; then the scene is not to be
 * released. */
bool plan_scene_load(const struct plan *p, const char *path, const char *name, struct scene *scene, int *depth,
                     struct reference *stored, struct error *err);

/* plan_names_differ: no two scenes of the plan have the same name, under which their results are kept. False with a
 * message. */
bool plan_names_differ(const struct plan *p, struct error *err);

#endif
