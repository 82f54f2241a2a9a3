/* patience.h: may learning continue? Learning asks job->watch, one call at a time, after each chunk of work. Since a
 * chunk may take long, each thread also asks before a path if it has not asked for a fiftieth of a second. After the
 * first no, nobody asks again. In a scene without lights the answer is no from the beginning.
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
    double traced; /* number of sub-paths so far */
    bool over;
};

struct patience patience_begin(const struct render_job *job);
void patience_end(struct patience *p);

/* patience_lasts: thread-safe.
 *   asked  in-out, of the thread: the time at which it last asked job->watch, in seconds; 0 at first */
bool patience_lasts(struct patience *p, double *asked);

/* patience_count: count `traced` more sub-paths, and ask. Thread-safe. */
bool patience_count(struct patience *p, double traced);

#endif
