/* load_job.c: see commands.h. */
#include "lab/commands.h"

int load_job(struct render_job *job, struct scene *scene, struct prepared *out)
{
    struct error err;
    return job_load(job, scene, out, &err) ? EXIT_OK : job_failed(&err);
}
