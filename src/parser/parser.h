/* parser.h: from a pbrt-v3 scene file to a scene.
 *
 * The subset is listed in doc/scene-format.md. What would change the picture is refused with "FILE:LINE:COL: ...";
 * where the picture is pbrt-v3's all the same, a warning says what is done.
 * After an error reading goes on, so that one run finds all, up to MOST_ERRORS.
 * Tests: test_parser.c, whose fixtures carry the error they expect. */
#ifndef ASBDPT_PARSER_H
#define ASBDPT_PARSER_H

#include "base/error.h"
#include "parser/messages.h" /* struct message_sink */
#include "scene/scene.h"

/* What the user says of a scene before it is read; all zeros: nothing. */
struct parse_options {
    const char *integrator; /* before the scene's own it says whether media are seen */
    double max_memory;      /* see budget_new */
    const char *text;       /* [length] of the main file, which is not read then; or NULL */
    size_t length;
};

/* parse_scene: read a file and everything it includes.
 *   options  may be NULL
 *   out   initialised by this function; on success to be released with scene_free; not yet prepared
 *   sink  may be NULL; receives warnings and errors as they are found
 *   err   may be NULL; the first error
 * Returns false after an error; *out is then empty and needs no release. */
bool parse_scene(const char *path, const struct parse_options *options, struct scene *out,
                 const struct message_sink *sink, struct error *err);

#endif
