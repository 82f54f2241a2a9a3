/* store.c: see store.h. */
#include "lab/store.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/os.h"
#include "image/image.h"
#include "image/zlib.h"
#include "lab/files.h"

enum { PATH_SIZE = 4096 };

static void path_of(const char *directory, const char *name, const char *extension, char out[PATH_SIZE])
{
    snprintf(out, PATH_SIZE, "%s/%s.%s", directory, name, extension);
}

unsigned long store_checksum(const float *pixels, int width, int height)
{
    return checksum_crc32(0, (const uint8_t *)pixels, (size_t)width * (size_t)height * 3 * sizeof *pixels);
}

/* Of the picture and the numbers. */
static unsigned long crc_of(const struct record *r)
{
    unsigned long picture = r->pixels != NULL ? store_checksum(r->pixels, r->width, r->height) : 0;
    return checksum_crc32((uint32_t)picture, (const uint8_t *)r->number, sizeof r->number);
}

/* Three lines: the key, the numbers, the picture's size and the checksum of both. */
static bool read_text(FILE *f, const char *key, struct record *out, unsigned long *crc)
{
    char line[STORE_KEY + 4] = "", end = 0;
    size_t n = strlen(key);
    bool ok = fgets(line, sizeof line, f) != NULL && strncmp(line, key, n) == 0 && strcmp(line + n, "\n") == 0;
    for (int i = 0; ok && i < STORE_NUMBERS; i++)
        ok = fscanf(f, "%lf", &out->number[i]) == 1 && isfinite(out->number[i]);
    return ok && fscanf(f, "%d x %d %lx%c", &out->width, &out->height, crc, &end) == 4 && end == '\n';
}

bool store_read(const char *directory, const char *name, const char *key, struct record *out)
{
    char path[PATH_SIZE];
    struct record in = {{0}, NULL, 0, 0};
    unsigned long crc;
    path_of(directory, name, "txt", path);
    FILE *f = os_open_input(path);
    if (f == NULL)
        return false;
    bool ok = read_text(f, key, &in, &crc);
    int width = in.width, height = in.height;
    fclose(f);
    if (ok && width > 0) {
        path_of(directory, name, "pfm", path);
        in.pixels = image_read_linear(path, &in.width, &in.height, NULL, NULL);
        ok = in.pixels != NULL && in.width == width && in.height == height;
    }
    ok = ok && crc_of(&in) == crc;
    if (ok)
        *out = in;
    else
        free(in.pixels);
    return ok;
}

bool store_write(const char *directory, const char *name, const char *key, const struct record *r, struct error *err)
{
    char path[PATH_SIZE];
    struct file_output f;
    path_of(directory, name, "pfm", path);
    if (r->pixels != NULL && !image_write(path, r->width, r->height, r->pixels, err))
        return false;
    path_of(directory, name, "txt", path);
    if (!file_create(path, &f, err))
        return false;
    fprintf(f.stream, "%s\n", key);
    for (int i = 0; i < STORE_NUMBERS; i++)
        fprintf(f.stream, "%.17g%s", r->number[i], i + 1 < STORE_NUMBERS ? " " : "\n");
    fprintf(f.stream, "%d x %d %08lx\n", r->width, r->height, crc_of(r));
    return file_commit(&f, err);
}
