/* strategy_files.h: render --strategies: two pictures of every strategy (s,t), its whole estimate and its weighted
 * share, and all of them on one sheet.
 *
 * A NULL directory: none are wanted, and nothing is done. Tests: test/cli.sh, test/outputs.sh.
 */
#ifndef ASBDPT_STRATEGY_FILES_H
#define ASBDPT_STRATEGY_FILES_H

#include "cli/names.h"
#include "scene/film.h"
#include "scene/scene.h"

/* Paths of up to d + 1 edges have (d + 1) (d + 4) pictures. */
enum { STRATEGIES_MAX_DEPTH = 20 };

/* strategies_possible: make the directory; can files be made in it? False with a message. */
bool strategies_possible(const char *directory, struct error *err);

/* strategies_check: once the scene is loaded: are there not too many, and none of them another file?
 *   max_depth  of the options, 0: the scene's
 *   all        the files of the command; in-out */
bool strategies_check(const char *directory, const struct scene *scene, int max_depth, struct names *all,
                      struct error *err);

/* strategies_write: of a film that has kept them. A signal that comes while they are written ends it. */
bool strategies_write(const char *directory, const struct film *film, double scale, struct error *err);

#endif
