/* directory.h: directories for what the laboratory writes. */
#ifndef ASBDPT_DIRECTORY_H
#define ASBDPT_DIRECTORY_H

#include "base/error.h"

/* file_make_directory: a directory and those above it, unless they are there. Returns false with a message. */
bool file_make_directory(const char *path, struct error *err);

#endif
