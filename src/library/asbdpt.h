/* asbdpt.h: the renderer as a library, for programs, notebooks and pages. C99 and C++.
 *
 *     asbdpt *r = asbdpt_new();
 *     if (asbdpt_set(r, "--integrator", "bdpt") || asbdpt_open(r, "scene.pbrt") || asbdpt_render(r, 64, NULL, NULL, NULL) ||
 *         asbdpt_save(r, "picture.png"))
 *         fprintf(stderr, "%s\n", asbdpt_message(r));
 *     asbdpt_free(r);
 *
 * Order: options, then one scene, then all else, in any order and any number of times. A call that comes too early or
 * too late is refused. A function that returns int returns 0, or 1 and leaves a message; nothing of the render is lost
 * then. The library writes no standard output. On stderr it says only how many values a .exr had to cut. Running out
 * of memory ends the process with a message, as in the program; what a scene would take is asked first (--max-memory).
 *
 * Threads: a render belongs to one thread at a time; several renders may be under way in several threads. Their only
 * shared state is a list of temporary files, behind a lock. No call touches signals or the locale; numbers in texts
 * need the "C" locale, which is a program's at first. The same scene, seed and samples give the same bytes, for any
 * number of threads, in one call or in many.
 *
 * Tests: test_library.c, test/run/embed.sh. */
#ifndef ASBDPT_H
#define ASBDPT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A render: one scene, its options, what has been learnt, and its film. */
typedef struct asbdpt asbdpt;

/* asbdpt_version: "asbdpt 1.2", static. */
const char *asbdpt_version(void);

/* asbdpt_new: a render without a scene; never NULL. asbdpt_free: release all that is its own; NULL is allowed. */
asbdpt *asbdpt_new(void);
void asbdpt_free(asbdpt *r);

/* asbdpt_message: why the last call that returned 1 did so, one line or several; of a scene "FILE:LINE:COLUMN: ...".
 * "" before the first. asbdpt_warnings: what was said of the scene, a line each; "" if there is nothing. Both are valid
 * until the next call with this render. */
const char *asbdpt_message(const asbdpt *r);
const char *asbdpt_warnings(const asbdpt *r);

/* asbdpt_set: an option of the command line by its name: --integrator, -P (NAME=VALUE), --spp, --seed, --nthreads,
 * --maxdepth, --res, --filter, --cropwindow, --max-memory, --noise, --noise8, --samples, --quick, --strict. `asbdpt
 * render --help` explains them. The texts are copied.
 *   value  NULL for an option without a value */
int asbdpt_set(asbdpt *r, const char *option, const char *value);

/* asbdpt_parameter: number 0, 1, 2 ... of all parameters of all methods. Returns 0 behind the last, else 1. */
struct asbdpt_parameter {
    const char *method, *select; /* --integrator, and -P select= if that names several rows, else NULL; static */
    const char *name;            /* of -P; NULL: the method itself; static */
    const char *help;            /* static */
    char fallback[64];           /* the default as a text */
};
int asbdpt_parameter(int number, struct asbdpt_parameter *out);

/* asbdpt_open: read a scene file and all that it names, and begin an empty film. Not "-".
 * asbdpt_open_text: the same of a text, which is copied.
 *   name  the path that messages show; files that the text names are searched in its folder
 *   text  [length] bytes */
int asbdpt_open(asbdpt *r, const char *path);
int asbdpt_open_text(asbdpt *r, const char *name, const char *text, size_t length);

/* asbdpt_size: pixels of the picture: of the film, or of its crop. */
int asbdpt_size(asbdpt *r, int *width, int *height);

/* What asbdpt_cancel answers. The answer may only become more urgent during a call of asbdpt_render. */
enum { ASBDPT_CONTINUE, ASBDPT_END_BLOCK, ASBDPT_STOP }; /* END_BLOCK: when all pixels have the same samples again */

/* The shares of learning and of the samples that are done, in [0,1]: called by any thread of the render, one call at a
 * time. asbdpt_read, asbdpt_error and asbdpt_save may be called within it: the picture so far.
 * asbdpt_cancel: is the render to end? Called before every sample, by any thread, several at once: it must be quick. */
typedef void asbdpt_progress(void *context, double learnt, double done);
typedef int asbdpt_cancel(void *context);

/* asbdpt_render: render some more samples of each pixel, first learning if the method learns.
 *   samples   how many; they end with a whole four where the filter has negative lobes, and with a block of
 *             select=bins. With restart=0 all of --spp is one block, and no call can add to it
 *             0: all that are missing of --spp. Neither goes on once --noise is reached
 *   progress, cancel  may be NULL; `context` is passed to both
 * A render that is cancelled is no error; the next call continues it. If it was cancelled while it learnt, its samples
 * go by what it had learnt; they are kept in no part or checkpoint, and cannot continue one. */
int asbdpt_render(asbdpt *r, long samples, asbdpt_progress *progress, asbdpt_cancel *cancel, void *context);

/* asbdpt_samples: samples of each pixel so far, in the mean. -1 without a scene. */
double asbdpt_samples(const asbdpt *r);

/* asbdpt_read: the picture so far: [height*width*3] linear RGB, top row first, radiance in W/(sr m^2) times the film's
 * scale. Black without samples.
 * asbdpt_error: of the same shape: half the absolute difference of the pictures of either half of the samples. Its
 * square is an unbiased estimate of the variance of independent samples, from one difference: take means of squares over
 * pixels. Needs asbdpt_keep_error, and as many samples as the message of a refusal says.
 * asbdpt_keep_error: to be called between opening and the first sample; the film takes twice the memory. */
int asbdpt_read(asbdpt *r, float *pixels);
int asbdpt_error(asbdpt *r, float *pixels);
int asbdpt_keep_error(asbdpt *r);

/* asbdpt_statistics: what was rendered and how, the JSON object of --stats: parameters, samples, seconds, memory, what
 * the method chose. Valid until the next call with this render. NULL without a scene. */
const char *asbdpt_statistics(asbdpt *r);

/* asbdpt_save: the picture so far in the format of the name: .pfm, .exr, .float.exr, .png, .ppm; or .part, all samples
 * so far for `asbdpt merge`. Values below 0 become 0. The file appears whole or not at all.
 * asbdpt_save_checkpoint, asbdpt_load_checkpoint: the film, to be continued by a render of the same scene and options,
 * of this library or of the program; the bytes of the picture are those of a render without a break. To be loaded
 * before the first sample. */
int asbdpt_save(asbdpt *r, const char *path);
int asbdpt_save_checkpoint(asbdpt *r, const char *path);
int asbdpt_load_checkpoint(asbdpt *r, const char *path);

/* --- paths -------------------------------------------------------------------------------------------- */

enum { ASBDPT_LENS, ASBDPT_LIGHT, ASBDPT_SURFACE, ASBDPT_MEDIUM, ASBDPT_ESCAPED };

struct asbdpt_vertex {
    int kind;       /* of the above; ESCAPED: a direction, of the sky */
    double p[3];    /* in the coordinates of the scene file; ESCAPED: the origin */
    double n[3];    /* geometric normal, of unit length; 0 where there is none */
    double beta[3]; /* throughput of its sub-path on arrival */
    double pdf;     /* of the vertex in its sub-path: 1/m^2; within a medium 1/m^3; of a direction 1/sr */
};

/* A path that was added to the picture: its first s vertices are of a light sub-path, the other t of an eye sub-path. */
struct asbdpt_path {
    int s, t;
    int x, y;        /* the sample's pixel of the whole film */
    long sample;     /* its number */
    double px, py;   /* t = 1: the raster point at which it arrives */
    double value[3]; /* contribution without its weight, but with all other factors: it is value times weight that the
                      * picture receives: W/(sr m^2); t = 1: of all samples of the film */
    double weight;   /* of multiple importance sampling, in [0,1] */
    const struct asbdpt_vertex *vertex; /* [n] from the light to the lens; t = 1: the last is the middle of the lens */
    int n;           /* s + t; 0 where a method does not keep them */
};

/* asbdpt_observe: be called with every path whose value is not black; a NULL function ends it. The picture stays the
 * same. The function is called by the threads of the render, several at once: take a lock, or --nthreads 1. The path is
 * valid during the call. Of a tile pass that is cancelled, paths are told that the picture does not have. */
typedef void asbdpt_observer(void *context, const struct asbdpt_path *path);
int asbdpt_observe(asbdpt *r, asbdpt_observer *observer, void *context);

#ifdef __cplusplus
}
#endif
#endif
