/* image_write.c: see image_write.h. */
#include "lab/image_write.h"

#include "image/image.h"

bool image_write(const char *path, int width, int height, const float *pixels, struct error *err)
{
    struct file_output f;
    const struct raster r = {{0, 0, 0, 0}, width, height, pixels, NULL, 0};
    return image_create(path, &f, err) && image_finish(&f, &r, err);
}
