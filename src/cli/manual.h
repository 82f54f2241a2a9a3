/* manual.h: what tells a system about the program, made from the tables of commands and options: a man page, and
 * completion for two shells. `make install` puts them where they belong.
 *
 * Tests: test/cli.sh.
 */
#ifndef ASBDPT_MANUAL_H
#define ASBDPT_MANUAL_H

#include <stdbool.h>

/* manual_print: "man" (roff with the macros of man(7)), "bash" or "zsh" to standard output; false for another topic.
 *   version  of the program, as --version prints it */
bool manual_print(const char *topic, const char *version);

/* manual_print_integrators: the integrators and their parameters, as --help has them. */
void manual_print_integrators(void);

#endif
