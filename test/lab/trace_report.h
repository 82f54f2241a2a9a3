/* trace_report.h: what the witness of a pixel sample (trace.h) has to tell.
 *
 * Tests: test_trace.c, test/run/cli.sh.
 */
#ifndef ASBDPT_TRACE_REPORT_H
#define ASBDPT_TRACE_REPORT_H

#include <stdio.h>

#include "lab/trace.h"

/* What is told, and of what. */
struct trace_story {
    const char *scene_path;
    const struct scene *scene;
    const struct method *integrator;
    uint64_t seed;
    const struct trace *trace;
};

/* trace_tell: some ten lines, and with `all` trace_text after them, a page to read. */
void trace_tell(FILE *f, const struct trace_story *story, bool all);
void trace_text(FILE *f, const struct trace_story *story);

/* trace_values: a line for each number: its name, and the number or words. z.I.beta and others are of an eye vertex,
 * c.J.C and others of a connection to the pixel, from 1 on, c.J.y.beta of its light end; c.most is the pair that
 * contributes most. sum: of all; pixel: with what light sub-paths of the image add to it by t = 1. */
void trace_values(FILE *f, const struct trace_story *story);

/* trace_name_joined: what a connection joins: "y_2 - z_1", or "y_2(5) - z_1" of the fifth light sub-path. */
enum { TRACE_JOINED = 64 };
void trace_name_joined(const struct trace *trace, const struct trace_connection *c, char out[TRACE_JOINED]);

/* trace_what: what a vertex is, in a word or two. trace_measure: what its densities are per: "m^2", "sr", or "" where
 * they are probabilities, of lights that are a point or a direction; NULL for the lens. */
const char *trace_what(const struct scene *scene, const struct vertex *v);
const char *trace_measure(const struct scene *scene, const struct vertex *v);

/* trace_place: where a vertex is, in *out; of what is infinitely far the direction towards it, and it returns true. */
bool trace_place(const struct scene *scene, const struct vertex *v, vec3 *out);

/* trace_svg: the sub-paths and connections within the scene's outlines, from the camera and from above, as an SVG file
 * that needs nothing else. */
void trace_svg(FILE *f, const struct trace_story *story);

#endif
