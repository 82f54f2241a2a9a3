/* files.c: see files.h. */
#include "lab/files.h"

#include <stdlib.h>

#include "base/mem.h"
#include "base/os.h"
#include "image/image.h"

bool image_write(const char *path, int width, int height, const float *pixels, struct error *err)
{
    struct file_output f;
    const struct raster r = {{0, 0, 0, 0}, width, height, pixels, NULL, 0, false};
    return image_create(path, &f, err) && image_finish(&f, &r, err);
}

bool file_make_directory(const char *path, struct error *err)
{
    char *above = mem_copy_text(path);
    for (size_t i = 1; path[0] != '\0' && path[i] != '\0'; i++)
        if (os_separator(path[i])) {
            above[i] = '\0';
            os_make_directory(above); /* if that fails, the last one says so */
            above[i] = path[i];
        }
    free(above);
    return os_make_directory(path) || error_set(err, "%s: cannot make this directory", path);
}
