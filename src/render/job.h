/* job.h: what is to be rendered, settled once: from what a user asks of a file to a scene and a job. The options of a
 * render and the text of a scene's settings become a job before the scene is prepared; nobody looks them up again.
 *
 *     job_load: parse -> what the user asks -> job_adapt -> job_settle -> scene_prepare
 *     render_scene: job_prepare (what is learnt) -> tile passes
 *
 * Settings of a scene file are for pbrt-v3, whose integrators have others than ours: what has no effect here is taken
 * out, with a warning. Those of -P must be right.
 *
 * Tests: test_render.c, test_options.c, test/run/cli.sh, test/run/add_method.sh.
 */
#ifndef ASBDPT_JOB_H
#define ASBDPT_JOB_H

#include "integrators/prepare.h"
#include "parser/messages.h" /* struct message_sink */

/* --- methods ------------------------------------------------------------------------------------------ */

/* What is linked into an executable, ended by NULL; of rows that share a name, which are neighbours, the first is the
 * default. asbdpt has its own in rows.c, the laboratory one that is longer. */
extern const struct method *const method_rows[];

/* Names of methods that the executable has not, but asbdpt-lab, ended by NULL. */
extern const char *const method_elsewhere[];

/* method_find: the row of an integrator ("path" is pbrt's name of pt); the setting `select` chooses among several. NULL
 * with a message that names all if there is none. */
const struct method *method_find(const char *name, const struct settings *s, struct error *err);

/* --- settings ----------------------------------------------------------------------------------------- */

/* job_common: the parameters that all integrators have, ended by a NULL name. */
const struct field *job_common(void);
extern const char *const LIGHT_STRATEGIES[]; /* by enum light_strategy */

/* job_adapt: take out and replace what pbrt-v3 knows and this program does not, or pbrt-v3 would pass over. Returns
 * false with a message if -P sets what none of the readers has.
 *   readers  the methods that will read the settings, ended by NULL
 *   sink     hears of each; may be NULL */
bool job_adapt(struct scene *scene, const struct method *const *readers, const struct message_sink *sink,
               struct error *err);

/* --- jobs --------------------------------------------------------------------------------------------- */

struct observers; /* render.h */

/* Go on; stop when the block of iterations under way is complete; stop at once, between two tile passes. The later the
 * more urgent. */
enum render_wish { RENDER_GO_ON, RENDER_END_BLOCK, RENDER_STOP };

struct render_options {
    const struct method *integrator;
    uint64_t seed;
    long first, end; /* iterations [first, end) of every pixel */
    long planned;    /* samples per pixel of the whole picture if these are a part of it; 0: `end` */
    bool is_part;    /* these are to be added to others: they must be whole blocks, where the method says how long */
    int block;       /* iterations of a block where the method leaves that open; 0: by the picture's size */
    int n_threads;   /* 0: one per processor */
    int max_depth;   /* 0: what the scene says, else 5 */
    double noise[N_NOISE_SCALES]; /* stop when the film's are below; 0: never. The film must keep halves */
    const struct observers *observers; /* who looks on at every path; NULL: nobody */
    /* Called after each tile pass with the share of the work done, in (0,1], one call at a time and while nothing else
     * touches the film. NULL: not called. While the method learns it is called, too, with 0; if it is not to go on
     * then, that ends with what has been learnt, by which one block is rendered, or at RENDER_STOP one tile pass,
     * unless `stop` ends that, if the film is empty. */
    enum render_wish (*progress)(void *context, double done);
    /* Asked before every sample, by any thread, with the same context: is the render to stop, even without the tile
     * passes under way? Once true, always. NULL: never. */
    bool (*stop)(void *context);
    void *progress_context;
};

struct job {
    struct render_options options; /* with all defaults in their places */
    struct render_job state;       /* what all tile passes read */
    struct prepared prepared;      /* the method and its parameters; after job_prepare what it has learnt */
};

/* job_settle: read the options, and all settings of the scene, which must outlive the job; it need not be prepared yet.
 * Returns false with a message on a setting that is wrong; nothing needs release then. Else job_free must follow.
 * job_prepare: whatever the method does before the first tile pass, for the pixels state.film_rect of the prepared
 * scene, once. */
bool job_settle(const struct scene *scene, const struct render_options *options, struct job *out, struct error *err);
void job_prepare(struct job *job);
void job_free(struct job *job);

/* render_crop: the pixels of the scene's crop window, as pbrt rounds it. */
struct pixel_rect render_crop(const struct scene *scene);

/* --- loading ------------------------------------------------------------------------------------------ */

/* What a user asks of a scene. 0 and NULL: as the scene says. */
struct job_request {
    const char *scene_path, *integrator, *filter;
    const char *const *set; /* [n_set] NAME=VALUE, parameters of the integrator */
    int n_set;
    int spp, max_depth;
    int width, height;  /* of the film; height 0: the same shape */
    const double *crop; /* x0, x1, y0, y1 */
    int n_threads;      /* 0: one per processor */
    double max_memory;  /* bytes; 0: what is usual (budget_new) */
    uint64_t seed;
    bool quick;         /* a quarter of the width and height, one sample, unless others say otherwise */
    bool strict, quiet; /* warnings are errors; say nothing but warnings and errors */
};

/* job_load: parse the scene, put what is asked in the place of what it says, settle the job, whose samples are those
 * asked for or of the scene, else 16, in whole cycles of the filter (filter.h), and prepare the scene. Warnings go to
 * stderr. After success job_free and scene_free must follow. Returns false with a message, which is empty if all has
 * been said already.
 * job_open, job_ready: the same in two steps, between which the method may be replaced by others.
 *   readers  all methods that will read the settings, ended by NULL; the job is the first one's. job_ready releases the
 *            scene if it fails */
bool job_load(const struct job_request *q, struct scene *scene, struct job *job, struct error *err);
bool job_open(const struct job_request *q, struct scene *scene, const struct method **method, struct error *err);
bool job_ready(const struct job_request *q, const struct method *const *readers, struct scene *scene, struct job *job,
               struct error *err);

#endif
