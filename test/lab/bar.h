/* bar.h: the bar (base/progress.h) of a command that renders, once or several times.
 *
 *     bar_start; bar_follow and a render by these options, bar_part and other work, ...; bar_clear
 *
 * Tests: test/run/progress.sh.
 */
#ifndef ASBDPT_LAB_BAR_H
#define ASBDPT_LAB_BAR_H

#include "base/progress.h"
#include "render/job.h"

struct bar {
    struct progress progress;
    double begun, share; /* of all work: what was done before the part under way, and this part; each in [0,1] */
};

/* bar_start: nothing is done; nothing is shown if `quiet`. bar_part: the part before is done, the next one is such a
 * share of all work. bar_follow: so, too, and a render by these options moves the bar, which must live as long.
 * bar_clear: remove it, so that a line can be printed; the next part shows it again. */
void bar_start(struct bar *b, bool quiet);
void bar_part(struct bar *b, double share);
void bar_follow(struct bar *b, double share, struct render_job *o);
void bar_clear(struct bar *b);

#endif
