/* parameters.h: what the settings of a scene say to every integrator.
 *
 * Those of a scene file are for pbrt-v3, whose integrators have others than ours: what has no effect here is said and
 * taken out. Those of -P must be right.
 *
 * Tests: test_render.c, test/cli.sh.
 */
#ifndef ASBDPT_PARAMETERS_H
#define ASBDPT_PARAMETERS_H

#include "render/methods.h"
#include "parser/source_position.h" /* struct message_sink */

/* parameters_common: what all integrators have, ended by a NULL name. */
const struct field *parameters_common(void);

/* parameters_adapt: take out and replace what pbrt-v3 knows and this program does not, or pbrt-v3 would pass over.
 *   readers  the methods that will read them, ended by NULL
 *   sink     hears of each; may be NULL */
void parameters_adapt(struct scene *scene, const struct method *const *readers, const struct message_sink *sink);

/* parameters_belong: does one of the readers have what -P sets? False with a message if not. */
bool parameters_belong(const struct scene *scene, const struct method *const *readers, struct error *err);

/* parameters_read: the settings that all integrators share, into max_depth, power_heuristic, spatial_lights and
 * rr_threshold of the job.
 *   max_depth  what the user wants, or 0: what the scene says, else 5
 * Returns false with a message on a setting that is wrong, also of those that this method alone has. */
bool parameters_read(const struct scene *scene, const struct method *m, int max_depth, struct render_job *job,
                     struct error *err);

/* parameters_max_depth: that depth alone. */
bool parameters_max_depth(const struct scene *scene, int wanted, int *out, struct error *err);

#endif
