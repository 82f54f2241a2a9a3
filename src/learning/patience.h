/* patience.h: may learning go on? job->watch says so, one call at a time: whenever a chunk of work is counted, and,
 * since a chunk may take long, before a path of any thread that has not asked for a fiftieth of a second. After the
 * first no it is not asked again. In a scene without light the answer is no from the beginning.
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
 *   asked  in-out, of the thread: when it last asked job->watch, by the clock; 0 at first */
bool patience_lasts(struct patience *p, double *asked);

/* patience_count: so many sub-paths more; does it last? Thread-safe. */
bool patience_count(struct patience *p, double traced);

#endif
