/* methods.h: the table of all methods, which are rows (integrators/method.h) of the rooms below.
 *
 * Tests: test_render.c, test_options.c, test/add_method.sh.
 */
#ifndef ASBDPT_METHODS_H
#define ASBDPT_METHODS_H

#include "integrators/method.h"

/* What is linked into an executable, ended by NULL; of rows that share a name, which are neighbours, the first is the
 * default. asbdpt has its own in rows.c, the laboratory one that is longer. */
extern const struct method *const method_rows[];

/* method_exists: is there an integrator of that name ("path", pbrt's name of pt, among them)? */
bool method_exists(const char *name);

/* method_find: the row of an integrator; the setting `select` chooses among several. NULL with a message if there is
 * none. */
const struct method *method_find(const char *name, const struct settings *s, struct error *err);

#endif
