/* patience.h: may learning go on? Its threads ask before each path, however dear one is; job->watch is asked in turn
 * where work is counted, and every fiftieth of a second. Who is told to stop once is always told so; of a scene without
 * light there is nothing to learn.
 *
 * Tests: test_learning.c.
 */
#ifndef ASBDPT_PATIENCE_H
#define ASBDPT_PATIENCE_H

#include "base/os.h"
#include "transport/tile_pass.h"

struct patience {
    const struct render_job *job;
    struct os_lock *lock;
    double traced; /* sub-paths counted so far */
    bool over;
};

struct patience patience_begin(const struct render_job *job);
void patience_end(struct patience *p);

/* patience_lasts: thread-safe.
 *   asked  in-out: when the thread did so before, by the clock; 0 at first */
bool patience_lasts(struct patience *p, double *asked);

/* patience_count: so many sub-paths more; does it last? Thread-safe. */
bool patience_count(struct patience *p, double traced);

#endif
