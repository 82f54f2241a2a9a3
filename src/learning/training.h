/* training.h: the passes that fill the tables. All threads trace sub-paths, in chunks. Each chunk makes a list of
 * findings, and the lists are added up in order (parallel.h). So sums and the numbers of regions are the same for any
 * number of threads.
 *
 * A pass is a function from tables to tables with more in them. The tables that its walks use do not change meanwhile.
 */
#ifndef ASBDPT_TRAINING_H
#define ASBDPT_TRAINING_H

#include "learning/patience.h"
#include "tables/tables.h"
#include "transport/tile_pass.h"

/* One result of a sub-path. */
struct finding {
    enum { EYE_VERTEX, LIGHT_SEEN, RAY_LEFT, LIGHT_VERTEX, TRIAL } kind;
    vec3 p;              /* of a vertex */
    uint64_t eye, light; /* regions_key of the place, for eye and for light regions; TRIAL: of the eye and light end */
    int cell;            /* LIGHT_SEEN, RAY_LEFT: the light cell */
    double u[2];         /* RAY_LEFT: point of the square of emission.h */
    double x; /* vertices: luminance of beta; LIGHT_SEEN: contribution; RAY_LEFT, TRIAL: worth */
    double w; /* TRIAL: weight */
};

struct findings {
    struct finding *item; /* [n], owned */
    size_t n, capacity;
};

/* findings_add: add a finding, unless its value is zero, not finite or too large for sums. */
void findings_add(struct findings *list, struct finding f);

enum { CHUNK = 256 }; /* number of sub-paths of a chunk */

struct training {
    const struct render_job *job;
    struct workspace *work; /* [n_threads] */
    struct patience patience;
};

/* A pass over sub-paths first .. end-1. */
struct pass {
    struct training *training;
    struct mis_counts counts; /* of any values, since no weight is used; and counts.tables for walks and connections */
    long first, end;
    void *context; /* of the pass, for `trace` and `take` */
    /* List the findings of sub-path number i, which is traced in the thread's workspace. */
    void (*trace)(const struct pass *p, int thread, long i, struct findings *out);
    /* Add a finding to the sums of the pass. */
    void (*take)(void *context, const struct finding *f);
};
static inline struct mis_counts any_counts(const struct tables *known)
{
    return (struct mis_counts){.direct = {1, 1}, .tables = known};
}

/* pass_run: run the whole pass, unless patience ends. */
void pass_run(const struct pass *p);

/* pass_eye: trace eye sub-path number i into the thread's workspace, through point i of a low-discrepancy sequence over
 * the film. *sampler can be used further; its stream is (i, stream).
 * pass_light: trace light sub-path number i into path [max_depth + 1], its lobes into `arena`.
 * Both return the number of vertices. */
enum stream { STREAM_EYE, STREAM_LIGHT, STREAM_POOL, STREAM_EXTENT };
int pass_eye(const struct pass *p, int thread, long i, enum stream stream, struct sampler *sampler);
int pass_light(const struct pass *p, struct arena *arena, long i, enum stream stream, struct vertex *path);

/* --- the passes -------------------------------------------------------------------------------------- */

/* train_extent: the box that contains most eye vertices. */
void train_extent(struct training *t, vec3 *low, vec3 *high);

/* train_importance: add regions from n eye sub-paths, importance if E is allocated, and the guide if `guide`. */
struct tables train_importance(struct training *t, struct tables known, long n, bool guide);

/* train_emission: from light sub-paths 0 .. n-1; `delta` is that of emission_build.
 * train_vertices: means over the light vertices of n sub-paths from number `first` on. If `vertices` of importance.h is
 * allocated, also the vertices of each light region, and new regions. */
struct tables train_emission(struct training *t, struct tables known, long n, double delta);
struct tables train_vertices(struct training *t, struct tables known, long first, long n);

/* train_pairs: from trial connections of the eye sub-paths first .. first+n-1. `delta` is that of pairs_build, and the
 * share of trials that are chosen without importance. */
struct tables train_pairs(struct training *t, struct tables known, long first, long n, double delta);

#endif
