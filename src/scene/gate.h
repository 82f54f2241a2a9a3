/* gate.h: light that has come so far, and no farther: pictures of light in flight.
 *
 * Tests: test_gates.c.
 */
#ifndef ASBDPT_GATE_H
#define ASBDPT_GATE_H

#include <math.h>
#include <stdbool.h>

/* Of a path's length, in scene units (vertex.h): all from `begin` to below `end`. An infinite end takes in all that is
 * not below `begin`. */
struct gate {
    double begin, end;
};

/* gate_before: is a length below a bound of a gate? */
static inline bool gate_before(double length, double bound) { return bound == INFINITY || length < bound; }
static inline bool gate_holds(struct gate g, double length)
{
    return gate_before(length, g.end) && !gate_before(length, g.begin);
}

#endif
