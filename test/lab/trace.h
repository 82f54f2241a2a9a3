/* trace.h: a witness of one pixel sample: what was walked, connected and added to the film, by an observer
 * (transport/observer.h). What comes of it is no second computation that might differ: added up in their order, the
 * contributions are the film's value to the last bit. The rest is what it tells: trace_text.c, trace_svg.c.
 *
 * Tests: test_trace.c, test/run/cli.sh.
 */
#ifndef ASBDPT_TRACE_H
#define ASBDPT_TRACE_H

#include <stdio.h>

#include "lab/race_table.h"
#include "render/chosen.h"
#include "render/render.h"

/* Copies of vertices, without their lobes and `lamp`, which do not outlive the sample. */
struct trace_path {
    struct vertex *vertex; /* [n], owned */
    double *pdf_rev;       /* [n - 1] vertex_pdf_rev (caustics/derived.h) of all but the last; owned */
    int n;
    size_t capacity, pdf_capacity;
    const struct vertex *source; /* what was copied: how a sub-path is recognised */
};

/* What the value and the weight of a connection of y and z are made of (connect.c), computed once more. */
struct trace_weight {
    rgb f_y, f_z;                 /* BSDFs; of a light 1 */
    double cos_y, cos_z, distance;
    double n;                     /* of the strategy; 0: nothing of this is known: media, lights at infinity, t = 1 */
    double R_y, R_z;              /* densities in the other walk, 1/m^2 */
    double light_side, eye_side;  /* A_light and A_eye of mis.h */
};

/* One connection that was tried. */
struct trace_connection {
    int s, t;
    int light;           /* number of the light sub-path; -1: none (s <= 1) */
    double pmf;          /* probability with which it was chosen; 1: there was no choice */
    struct connection c; /* value C*, weight, light */
    double px, py;       /* t = 1: the raster point */
    vec3 end;            /* s = 1: the point on the light; at infinity, its direction. t = 1: on the lens */
    double scale;        /* what else C* is multiplied by: numbers of samples, filter, 1/probabilities of a choice */
    rgb added;           /* C* times scale times weight, as it was added; t = 1: at the raster point */
    struct trace_weight of;
};

enum { TRACE_BRIGHTEST = -1 };

struct trace {
    int x, y;       /* the sample to watch */
    long iteration; /* TRACE_BRIGHTEST: the one that contributes most to the pixel, light joined to the lens left out */
    double filter_weight;
    struct sampler lens; /* as it was before it drew lens points for the latest light sub-path */
    struct trace_path eye;
    struct trace_path *light; /* [n_lights], those that were connected or chosen; owned */
    int n_lights;
    struct trace_connection *connection; /* [n_connections] in the order of adding; owned */
    int n_connections;
    size_t light_capacity, connection_capacity;
    int n_pool;        /* K, light sub-paths that the pixels of the tile share */
    bool wants_splats; /* to be set before: find these, too, which takes all tiles */
    rgb splats;        /* what light sub-paths of all pixels add to this one in the sample's iteration, */
    int n_splats;      /* by so many vertices that were joined to the lens */
    const char *why;   /* how the method chooses what to connect with; NULL: it does not */
    struct race_result race;
    struct chosen_number number[CHOSEN_NUMBERS]; /* what it has chosen for itself, ended by an empty name */
};

/* A trace starts as zeros, except the sample to watch. trace_free releases what it owns. */
void trace_free(struct trace *trace);

/* trace_render: render one pixel sample, the one named in trace->x, y and iteration, exactly as render_scene with these
 * options would, and witness it; the rest of its tile comes along where it has light sub-paths in common.
 * Returns false with a message when there is no such sample or a parameter is bad. Either way trace_free follows. */
bool trace_render(const struct scene *scene, const struct render_job *options, struct trace *trace,
                  struct error *err);

/* trace_sample: the same by a method that render_prepare has prepared, of a sample that there is. */
void trace_sample(const struct render_job *job, const struct prepared *prepared, struct trace *trace);

/* trace_sum: what was added to the sample's own pixel: all with t >= 2, in their order. */
rgb trace_sum(const struct trace *trace);

/* trace_pdf_rev: the density with which a walk from the other end would have made vertex i, measured as its pdf_fwd,
 * given the two vertices after it; below 0 where the sub-path does not have them. */
double trace_pdf_rev(const struct scene *scene, const struct trace_path *path, int i);

/* --- what it tells -------------------------------------------------------------------------------------- */

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
