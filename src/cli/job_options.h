/* job_options.h: the options that the subcommands which load a scene share. A subcommand with options of its own has
 * struct render_job as the first member of its struct: offsets count from there. */
#ifndef ASBDPT_JOB_OPTIONS_H
#define ASBDPT_JOB_OPTIONS_H

#include "cli/options.h"
#include "render/job.h"

/* Of what takes samples; of all, to which these lead on. */
extern const struct option RUN_OPTIONS[], JOB_OPTIONS[];

/* load_job: job_load (render/job.h). Returns EXIT_OK, or another status after saying why. job_failed: say why it has
 * failed, unless that has been said; returns the exit status. */
int load_job(struct render_job *job, struct scene *scene, struct prepared *out);
int job_failed(const struct error *err);

/* job_spares: is none of these outputs a file that the scene was read from? False with a message. */
bool job_spares(const struct scene *scene, const struct texts *outputs, struct error *err);

#endif
