/* image_write.h: a picture that is in memory into a file. */
#ifndef ASBDPT_LAB_IMAGE_WRITE_H
#define ASBDPT_LAB_IMAGE_WRITE_H

#include "base/error.h"

/* image_write: image_create and image_finish (image/image.h), of linear RGB [height*width*3], top row first. */
bool image_write(const char *path, int width, int height, const float *pixels, struct error *err);

#endif
