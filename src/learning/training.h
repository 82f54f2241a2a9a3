/* training.h: the passes that fill the tables, and what they have in common: sub-paths are traced in chunks on all
 * threads, each chunk lists what it found, and the lists are added up in order (parallel.h): sums and the numbers of
 * regions are the same for any number of threads.
 *
 * A pass is a function from tables to tables that know more. Its walks go by tables that do not change meanwhile.
 */
#ifndef ASBDPT_TRAINING_H
#define ASBDPT_TRAINING_H

#include "learning/patience.h"
#include "tables/tables.h"
#include "transport/tile_pass.h"

/* Something a sub-path found. */
struct finding {
    enum { EYE_VERTEX, LIGHT_SEEN, RAY_LEFT, LIGHT_VERTEX, TRIAL } kind;
    vec3 p;              /* of a vertex */
    uint64_t eye, light; /* regions_key of its place as an eye vertex, as a light vertex; TRIAL: of either end's */
    int cell;            /* LIGHT_SEEN, RAY_LEFT: the light cell */
    double u[2];         /* RAY_LEFT: where in emission's square */
    double x; /* vertices: luminance of beta; LIGHT_SEEN: contribution; RAY_LEFT, TRIAL: worth */
    double w; /* TRIAL: weight */
};

struct findings {
    struct finding *item; /* [n], owned */
    size_t n, capacity;
};

/* findings_add: unless it is nothing, or of no use for sums. */
void findings_add(struct findings *list, struct finding f);

enum { CHUNK = 256 }; /* sub-paths per chunk */

struct training {
    const struct render_job *job;
    struct workspace *work; /* [n_threads] */
    struct patience patience;
};

/* A pass over sub-paths first .. end-1. */
struct pass {
    struct training *training;
    struct mis_counts counts; /* any, for no weights are used; and what walks and connections know, counts.tables */
    long first, end;
    void *context; /* of the pass, for: */
    /* list what sub-path number i finds, in the thread's workspace; */
    void (*trace)(const struct pass *p, int thread, long i, struct findings *out);
    /* take in a finding. */
    void (*take)(void *context, const struct finding *f);
};
static inline struct mis_counts any_counts(const struct tables *known)
{
    return (struct mis_counts){.direct = {1, 1}, .direct_delta = {1, 1}, .tables = known};
}

/* pass_run: all of it, unless patience ends. */
void pass_run(const struct pass *p);

/* pass_eye: eye sub-path number i, through point i of an even sequence over the film, into the thread's workspace;
 * *sampler goes on with its numbers, those of (i, stream). pass_light: light sub-path number i into path
 * [max_depth + 1], its lobes into `arena`. Both return its length. */
enum stream { STREAM_EYE, STREAM_LIGHT, STREAM_POOL, STREAM_EXTENT };
int pass_eye(const struct pass *p, int thread, long i, enum stream stream, struct sampler *sampler);
int pass_light(const struct pass *p, struct arena *arena, long i, enum stream stream, struct vertex *path);

/* --- the passes -------------------------------------------------------------------------------------- */

/* train_extent: the box in which most eye vertices are. */
void train_extent(struct training *t, vec3 *low, vec3 *high);

/* train_importance: regions and means by n eye sub-paths; importance if there is room for E, the guide if it is
 * wanted. */
struct tables train_importance(struct training *t, struct tables known, long n, bool guide);

/* train_emission: by light sub-paths 0 .. n-1; delta of emission_build. train_vertices: means over light vertices, by n
 * more from number `first` on; if there is room for them, also the vertices of each light region, new ones among
 * them. */
struct tables train_emission(struct training *t, struct tables known, long n, double delta);
struct tables train_vertices(struct training *t, struct tables known, long first, long n);

/* train_pairs: by connections tried from eye sub-paths first .. first+n-1; delta of pairs_build, and the share of
 * trials that do not look at importance. */
struct tables train_pairs(struct training *t, struct tables known, long first, long n, double delta);

#endif
