/* state.h: what a render is behind asbdpt.h: all that lies between the options and the film. The programs' subcommand
 * `render` has one, too, and does by these functions what the library does, with its own messages.
 *
 * Tests: test_library.c, test/run/checkpoint.sh. */
#ifndef ASBDPT_STATE_H
#define ASBDPT_STATE_H

#include "library/asbdpt.h"
#include "library/options.h"
#include "render/part.h"
#include "render/render.h"

/* A text that grows, ended by a zero byte; NULL where nothing was added. */
struct growing {
    char *text; /* owned */
    size_t n, capacity;
};
void growing_add(struct growing *t, const char *format, ...);

struct asbdpt {
    struct render_job job; /* first: options lead into it */
    bool open;             /* there is a scene, and all that follows: */
    bool by_parts;         /* a block that is incomplete may end elsewhere than those of a whole render */
    struct scene scene;
    struct prepared prepared;
    struct film film;
    struct part part;      /* what is being rendered */
    double load, wall, cpu, samples; /* seconds, of rendering since the film was begun or loaded; samples per pixel in
                                      * this time */
    asbdpt_progress *progress; /* of the call under way */
    asbdpt_cancel *cancel;
    void *context;
    asbdpt_observer *observer;
    void *observer_context;
    struct observers observers;
    /* Of the library: */
    struct texts kept; /* copies of what options say; owned */
    struct growing message, warnings, statistics;
    bool said;         /* the message is of the call under way */
};

/* state_open: load the scene that the job names, and begin a film. False with a message, empty if all has been said.
 * state_load: continue what a file holds. False with a message.
 * state_save: the film into a file. If learning was cut short, its samples are for this picture alone: the file holds
 * none, and a render that continues it begins again.
 * state_free: release all of the scene. */
bool state_open(struct asbdpt *r, struct error *err);
bool state_load(struct asbdpt *r, const char *path, struct error *err);
bool state_save(const struct asbdpt *r, const char *path, struct error *err);
void state_free(struct asbdpt *r);

/* state_render: see asbdpt_render. */
bool state_render(struct asbdpt *r, long samples, struct error *err);

/* stats_add: --stats, one object of JSON [RFC 8259].
 *   files       written pictures, and the checkpoint or NULL
 * stats_us_per_path: microseconds of CPU per sample of a pixel; 0 if there was none. */
void stats_add(struct growing *out, const struct asbdpt *r, const struct texts *files, const char *checkpoint);
double stats_us_per_path(const struct asbdpt *r);

#endif
