/* lessons.h: the passes of learning and what they have in common: sub-paths are traced in chunks on all threads, each
 * chunk lists what it found, and the lists are taken in in order (parallel.h): sums and the numbers of regions are the
 * same for any number of threads. What was learnt is put to use by later passes only; none adds regions while its walks
 * look them up.
 */
#ifndef ASBDPT_LESSONS_H
#define ASBDPT_LESSONS_H

#include "learning/learnt.h"
#include "transport/tile_pass.h"

/* Something a sub-path found. */
struct finding {
    enum { VISIT, LIGHT_SEEN, LIGHT_LEFT, LIGHT_VERTEX, TRIAL } kind;
    vec3 p, p_side; /* the vertex; TRIAL: its eye end */
    vec3 y, y_side; /* TRIAL: its light end */
    int cell;     /* LIGHT_SEEN, LIGHT_LEFT: the light cell */
    double u[2];  /* LIGHT_LEFT: where in emission's square */
    bool first;   /* VISIT: is it the first hit? */
    double x;     /* VISIT, LIGHT_VERTEX: luminance of beta; LIGHT_SEEN: contribution; LIGHT_LEFT, TRIAL: worth */
    double w;     /* TRIAL: weight */
};

struct findings {
    struct finding *item; /* [n], owned */
    size_t n, capacity;
};

/* findings_add: unless it is nothing, or of no use for sums. */
void findings_add(struct findings *list, struct finding f);

enum { CHUNK = 256 }; /* sub-paths per chunk */

/* Learning under way. */
struct lessons {
    const struct render_job *job;
    const struct wish *wish;
    struct learnt *learnt;    /* what walks look things up in */
    struct mis_counts counts; /* weights are not used here; any will do */
    struct workspace *work;   /* [n_threads] */
    long traced;              /* sub-paths so far, for job->watch */
    bool stopped;
};

/* A pass over sub-paths first .. end-1. */
struct pass {
    struct lessons *lessons;
    long first, end;
    void *context; /* of the pass, for the functions below */
    /* Sub-path number i; thread: whose. `begin`, unless NULL, is called first for each chunk. */
    void (*begin)(void *context, struct lessons *l, int thread, long chunk);
    void (*trace)(void *context, struct lessons *l, int thread, long i, struct findings *out);
    void (*take)(void *context, struct lessons *l, const struct finding *f);
};

/* pass_run: all of it, unless job->watch ends it. */
void pass_run(const struct pass *p);

/* lessons_eye: eye sub-path number i, through point i of an even sequence over the film, into the thread's workspace;
 * *sampler goes on with its numbers, those of (i, stream). lessons_light: light sub-path number i into path
 * [max_depth + 1], its lobes into `arena`. Both return its length. */
enum stream { STREAM_EYE, STREAM_LIGHT, STREAM_POOL, STREAM_EXTENT };
int lessons_eye(const struct lessons *l, int thread, long i, enum stream stream, struct sampler *sampler);
int lessons_light(const struct lessons *l, struct arena *arena, long i, enum stream stream, struct vertex *path);

/* visits_extent: the box in which most vertices are. visits_run: n eye sub-paths, for importance and, if it is wished
 * for, the guide. visits_emission: light sub-paths 0 .. n-1, for emission.
 * visits_light: n more from number first on, for the means over them. */
void visits_extent(struct lessons *l, vec3 *low, vec3 *high);
void visits_run(struct lessons *l, long n);
void visits_emission(struct lessons *l, long n);
void visits_light(struct lessons *l, long first, long n);

/* trials_run: eye sub-paths first .. first+n-1, from whose vertices connections are tried, for the pairs. */
void trials_run(struct lessons *l, long first, long n);

#endif
