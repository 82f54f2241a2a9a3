/* commands.h: the subcommands that asbdpt-lab has and asbdpt has not, each in its cmd_*.c,
 * and `render` with its methods. */
#ifndef ASBDPT_LAB_COMMANDS_H
#define ASBDPT_LAB_COMMANDS_H

#include "cli/command.h"
#include "render/job.h"

extern const struct command command_verify, command_experiment, command_equal_time, command_family,
    command_transient, command_bench, command_info, command_compare, command_trace, command_worth,
    command_strategies, command_conform, command_render_more, command_sum, command_progress, command_corpus;

/* load_job: job_load (render/job.h). Returns EXIT_OK, or another status after saying why. */
static inline int load_job(struct render_job *job, struct scene *scene, struct prepared *out)
{
    struct error err;
    return job_load(job, scene, out, &err) ? EXIT_OK : job_failed(&err);
}

#endif
