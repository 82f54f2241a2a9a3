/* file.c: see file.h. */
#define _POSIX_C_SOURCE 200809L

#include "base/file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/mem.h"

static const size_t PIPE_LIMIT = (size_t)1 << 28;

/* Read to the end, in pieces that grow; `expected` is the length if it is known, else 0. */
static bool read_stream(FILE *f, size_t expected, size_t limit, uint8_t **data, size_t *size)
{
    size_t capacity = expected + 1; /* one more, to meet the end of the file without growing */
    *data = mem_alloc(capacity, 1);
    *size = 0;
    for (;;) {
        size_t got = fread(*data + *size, 1, capacity - *size, f);
        *size += got;
        if (*size > limit)
            return false;
        if (*size < capacity) {
            (*data)[*size] = 0;
            return ferror(f) == 0;
        }
        *data = mem_grow(*data, &capacity, capacity + 65536, 1);
    }
}

bool file_read(const char *path, uint8_t **data, size_t *size, struct error *err)
{
    *data = NULL;
    *size = 0;
    FILE *f = fopen(path, "rb");
    if (f == NULL)
        return error_set(err, "%s: cannot be opened: %s", path, strerror(errno));
    struct stat info;
    bool regular = fstat(fileno(f), &info) == 0 && S_ISREG(info.st_mode);
    if (regular && (uintmax_t)info.st_size >= SIZE_MAX / 2) {
        fclose(f);
        errno = 0;
        return error_set(err, "%s: the file is too large for this machine's memory", path);
    }
    size_t expected = regular ? (size_t)info.st_size : 0;
    errno = 0;
    bool ok = read_stream(f, expected, regular ? SIZE_MAX / 2 : PIPE_LIMIT, data, size);
    int reason = errno;
    fclose(f);
    if (ok) {
        (*data)[*size] = 0; /* read_stream left room */
        return true;
    }
    free(*data);
    *data = NULL;
    errno = reason;
    return error_set(err, "%s: cannot be read: %s", path, reason != 0 ? strerror(reason) : "endless or too long");
}

static void release(struct file_output *out)
{
    free(out->path);
    free(out->temporary);
    struct file_output none = {NULL, NULL, NULL};
    *out = none;
}

bool file_create(const char *path, struct file_output *out, struct error *err)
{
    struct stat info;
    bool special = stat(path, &info) == 0 && !S_ISREG(info.st_mode); /* a device or pipe must not be replaced */
    out->path = mem_copy_text(path);
    out->temporary = NULL;
    if (!special) {
        size_t room = strlen(path) + 32;
        out->temporary = mem_alloc(room, 1);
        snprintf(out->temporary, room, "%s.tmp-%ld", path, (long)getpid());
    }
    out->stream = fopen(special ? path : out->temporary, "wb");
    if (out->stream != NULL)
        return true;
    error_set(err, "%s: cannot be created: %s", path, strerror(errno));
    release(out);
    return false;
}

bool file_commit(struct file_output *out, struct error *err)
{
    errno = 0;
    bool ok = fflush(out->stream) == 0 && ferror(out->stream) == 0;
    int reason = errno;
    ok = fclose(out->stream) == 0 && ok;
    if (ok && out->temporary != NULL)
        ok = rename(out->temporary, out->path) == 0;
    reason = reason != 0 ? reason : errno;
    if (!ok) {
        error_set(err, "%s: cannot be written: %s", out->path, reason != 0 ? strerror(reason) : "write error");
        if (out->temporary != NULL)
            remove(out->temporary);
    }
    release(out);
    return ok;
}

void file_abandon(struct file_output *out)
{
    fclose(out->stream);
    if (out->temporary != NULL)
        remove(out->temporary);
    release(out);
}
