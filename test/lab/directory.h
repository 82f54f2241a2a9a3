/* directory.h: where reports and their pictures go. */
#ifndef LAB_DIRECTORY_H
#define LAB_DIRECTORY_H

#include "base/error.h"

/* directory_make: a directory and those above it, unless they are there. Returns false with a message. */
bool directory_make(const char *path, struct error *err);

#endif
