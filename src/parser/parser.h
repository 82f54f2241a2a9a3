/* parser.h: from a pbrt-v3 scene file to a scene.
 *
 * The subset is listed in doc/scene-format.md. What is outside it is refused with "FILE:LINE:COL: ..." and the
 * line with a caret under the column, or, where the image cannot suffer, warned about once.
 *
 * Tests: test_parser.c, whose fixtures carry the error they expect.
 */
#ifndef ASBDPT_PARSER_H
#define ASBDPT_PARSER_H

#include "base/error.h"
#include "parser/source_position.h" /* struct warning_sink */
#include "scene/scene.h"

/* parse_scene: read a file and everything it includes.
 *   out   initialised by this function; on success to be released with scene_free; not yet prepared
 *   sink  may be NULL: warnings are dropped
 * Returns false with a message; *out is then empty and needs no release. */
bool parse_scene(const char *path, struct scene *out, const struct warning_sink *sink, struct error *err);

#endif
