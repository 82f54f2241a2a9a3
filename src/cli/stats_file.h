/* stats_file.h: render --stats: what a render was of and how it went, as JSON for programs.
 *
 * The file is opened before the work begins and takes its name when every other file of the render is complete.
 * Tests: test/cli.sh.
 */
#ifndef ASBDPT_STATS_FILE_H
#define ASBDPT_STATS_FILE_H

#include "base/file.h"
#include "base/json.h"
#include "cli/aov_files.h"
#include "cli/job_options.h"

struct stats_file {
    bool wanted;
    struct file_output file;
    struct json json;
    double load_seconds;
};

/* How long a render took, and how many samples per pixel in that time. */
struct render_times {
    double wall, cpu; /* seconds */
    long samples;
};

/* render_us_per_path: microseconds of CPU per sample of a pixel; 0 if there was none. */
double render_us_per_path(const struct film *film, const struct render_times *times);

/* stats_open: begin the file; NULL: none is wanted, and the other functions do nothing. Returns false with a message;
 * nothing is open then. After success one of stats_write and stats_abandon must follow. */
bool stats_open(const char *path, struct stats_file *out, struct error *err);

/* stats_list: note the names of the files that are about to be written. */
void stats_list(struct stats_file *f, const struct job_options *o, const struct outputs *pictures,
                const struct aov_files *aov);

/* stats_write: all the rest, after stats_list. */
bool stats_write(struct stats_file *f, const struct job_options *o, const struct scene *scene,
                 const struct render_options *render, const struct film *film, const struct render_times *times,
                 struct error *err);

void stats_abandon(struct stats_file *f);

#endif
