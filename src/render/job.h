/* job.h: what is to be rendered, settled once: from what a user asks of a file to a scene and a method that can begin.
 * The options of a render and the text of a scene's settings become one struct, render_job.h's, before the scene is
 * prepared; nobody looks them up again.
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

/* job_settle: replace what the job leaves open by what the settings of the scene say, or by the usual, and read the
 * parameters of job->integrator. The scene, which need not be prepared yet, must outlive the job. Returns false with a
 * message on a setting that is wrong; nothing needs release then. Else method_release(out) must follow.
 * job_prepare: whatever the method does before the first tile pass, for the pixels job->film_rect of the prepared
 * scene, once. */
bool job_settle(struct render_job *job, const struct scene *scene, struct prepared *out, struct error *err);
void job_prepare(struct render_job *job, struct prepared *p);

/* job_asks_noise: is there a limit of noise? */
static inline bool job_asks_noise(const struct render_job *job)
{
    return job->noise[NOISE_RELATIVE] > 0 || job->noise[NOISE_8_BIT] > 0;
}

/* render_crop: the pixels of the scene's crop window, as pbrt rounds it. */
struct pixel_rect render_crop(const struct scene *scene);

/* --- loading ------------------------------------------------------------------------------------------ */

/* job_load: parse the scene, put what is asked in the place of what it says, settle the job, whose samples are those
 * asked for or of the scene, else 16, in whole cycles of the filter (filter.h), and prepare the scene. Warnings go to
 * stderr. After success method_release and scene_free must follow. Returns false with a message, which is empty if all
 * has been said already.
 * job_open, job_ready: the same in two steps, between which the method, job->integrator, may be replaced by others.
 *   readers  all methods that will read the settings, ended by NULL; the job is the first one's. job_ready releases the
 *            scene if it fails */
bool job_load(struct render_job *job, struct scene *scene, struct prepared *out, struct error *err);
bool job_open(struct render_job *job, struct scene *scene, struct error *err);
bool job_ready(struct render_job *job, const struct method *const *readers, struct scene *scene, struct prepared *out,
               struct error *err);

#endif
