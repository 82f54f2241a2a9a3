/* methods.h: the table of all methods, which are rows (integrators/method.h) of the rooms below.
 *
 * Tests: test_render.c, test_options.c, test/add_method.sh.
 */
#ifndef ASBDPT_METHODS_H
#define ASBDPT_METHODS_H

#include "integrators/method.h"

/* method_list: all rows, ended by NULL. Of rows that share a name the first is the default. */
const struct method *const *method_list(void);

/* method_exists: is there an integrator of that name ("path", pbrt's name of pt, among them)? */
bool method_exists(const char *name);

/* method_find: the row of an integrator; the setting `select` chooses among several. NULL with a message if there is
 * none. */
const struct method *method_find(const char *name, const struct settings *s, struct error *err);

#endif
