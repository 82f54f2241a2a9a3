/* stats_file.h: render --stats: what a render was of and how it went, as JSON for programs. Tests: test/cli.sh. */
#ifndef ASBDPT_STATS_FILE_H
#define ASBDPT_STATS_FILE_H

#include <stdio.h>

#include "cli/job_options.h"

/* How long a render took, and how many samples per pixel in that time. */
struct render_times {
    double load, wall, cpu; /* seconds */
    long samples;
};

/* render_us_per_path: microseconds of CPU per sample of a pixel; 0 if there was none. */
double render_us_per_path(const struct film *film, const struct render_times *times);

/* stats_write: one object.
 *   outputs  all files that are about to be written */
void stats_write(FILE *f, const struct job_options *o, const struct scene *scene, const struct render_options *render,
                 const struct film *film, const struct outputs *outputs, const struct render_times *times);

#endif
