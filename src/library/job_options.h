/* job_options.h: the options of all that load a scene: subcommands, and the library's renders. What has options of its
 * own has struct render_job as the first member of its struct: offsets count from there. */
#ifndef ASBDPT_JOB_OPTIONS_H
#define ASBDPT_JOB_OPTIONS_H

#include "library/options.h"
#include "render/job.h"

/* Of one render; of what takes samples; of all: each leads on to the next. */
extern const struct option LIMIT_OPTIONS[], RUN_OPTIONS[], JOB_OPTIONS[];

/* job_spares: is none of these outputs a file that the scene was read from? False with a message. */
bool job_spares(const struct scene *scene, const struct texts *outputs, struct error *err);

#endif
