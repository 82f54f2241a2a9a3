/* identity.h: what a picture is of, whatever its number of samples: all that changes a byte of a sample. */
#ifndef ASBDPT_IDENTITY_H
#define ASBDPT_IDENTITY_H

#include "render/render.h"

/* identity_text: lines, each a word and what it says, to be given to free(). Threads, names of files and what is written
 * do not belong to it; what the scene's files hold does. */
char *identity_text(const struct scene *scene, const struct render_options *o);

/* picture_number: a hash of these and of the film's size and window. */
uint64_t picture_number(const struct scene *scene, const struct render_options *o);

#endif
