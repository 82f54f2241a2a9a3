/* file.c: see file.h. */
#include "base/file.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/interrupt.h"
#include "base/mem.h"
#include "base/os.h"

static const size_t PIPE_LIMIT = (size_t)1 << 28;

/* A file of this length, and a zero. What follows, as in a file that is being written or some of the system that
 * say they are empty and never end, does not belong to it. */
static bool read_length(FILE *f, size_t length, uint8_t **data, size_t *size)
{
    *data = mem_alloc(length + 1, 1);
    *size = fread(*data, 1, length, f);
    (*data)[*size] = 0;
    return ferror(f) == 0;
}

/* A pipe to its end, in pieces that grow, and a zero. */
static bool read_pipe(FILE *f, uint8_t **data, size_t *size)
{
    for (size_t capacity = 0; *size == capacity;) {
        *data = mem_grow(*data, &capacity, capacity + 65536, 1);
        *size += fread(*data + *size, 1, capacity - *size, f);
        if (*size > PIPE_LIMIT)
            return false;
    }
    (*data)[*size] = 0;
    return ferror(f) == 0;
}

bool file_read(const char *path, uint8_t **data, size_t *size, struct error *err)
{
    *data = NULL;
    *size = 0;
    FILE *f = strcmp(path, "-") == 0 ? stdin : os_open_input(path);
    if (f == NULL)
        return error_set(err, "%s: cannot be opened: %s", path, strerror(errno));
    uint64_t length;
    enum os_kind kind = os_kind_of_stream(f, &length);
    os_binary(f);
    errno = 0;
    bool ok = kind != OS_FILE ? read_pipe(f, data, size)
                              : length < SIZE_MAX / 2 && read_length(f, (size_t)length, data, size);
    int reason = errno;
    if (f != stdin)
        fclose(f);
    if (ok)
        return true;
    free(*data);
    *data = NULL;
    errno = reason;
    return error_set(err, "%s: cannot be read: %s", path, reason != 0 ? strerror(reason) : "endless or too long");
}

bool file_exists(const char *path) { return os_kind_of(path) != OS_NOTHING; }

/* --- names ------------------------------------------------------------------------------------------- */

char *file_beside(const char *path, const char *name)
{
    const char *slash = os_absolute(name) ? NULL : os_last_separator(path);
    size_t length = slash != NULL ? (size_t)(slash - path) + 1 : 0;
    char *out = mem_alloc(length + strlen(name) + 1, 1);
    memcpy(out, path, length);
    strcpy(out + length, name);
    if (strcmp(out, "-") != 0)
        return out;
    free(out); /* a file of this name, not standard input */
    return mem_copy_text("./-");
}

bool file_has_extension(const char *path, const char *extension)
{
    size_t n = strlen(path), m = strlen(extension);
    for (size_t i = 0; i < m && n >= m; i++)
        if (tolower((unsigned char)path[n - m + i]) != extension[i])
            return false;
    return n >= m;
}

/* --- writing ----------------------------------------------------------------------------------------- */

/* Forget it all, and remove the temporary file unless it has the target's name by now. */
static void release(struct file_output *out, bool remove_it)
{
    if (out->temporary != NULL && remove_it)
        remove(out->temporary);
    if (out->temporary != NULL)
        temporary_forget(out->temporary);
    free(out->path);
    free(out->temporary);
    *out = (struct file_output){.stream = NULL};
}

/* A new file in the target's directory that nobody else has, with the rights of the one it is to replace. */
static FILE *open_temporary(struct file_output *out)
{
    char name[64];
    uint64_t hash = hash_combine(os_unique(), (uint64_t)(uintptr_t)out->path);
    snprintf(name, sizeof name, ".asbdpt-%08lx%08lx.tmp", (unsigned long)(hash >> 32),
             (unsigned long)(hash & 0xffffffffu));
    out->temporary = file_beside(out->path, name);
    temporary_add(out->temporary); /* before it is there: memory may run out */
    return os_create_new(out->temporary, out->path);
}

/* Devices, pipes and standard output are written directly; a file that must not be written is not replaced either. */
static FILE *open_target(struct file_output *out)
{
    if (strcmp(out->path, "-") == 0) {
        os_binary(stdout);
        return stdout;
    }
    errno = 0;
    enum os_kind kind = os_kind_of(out->path);
    if (kind == OS_NOTHING && errno != ENOENT && errno != 0) /* too long a name, for example */
        return NULL;
    if (kind == OS_DIRECTORY || kind == OS_OTHER)
        return fopen(out->path, "wb");
    if (kind == OS_FILE && !os_may_write(out->path))
        return NULL;
    return open_temporary(out);
}

bool file_create(const char *path, struct file_output *out, struct error *err)
{
    *out = (struct file_output){.path = mem_copy_text(path)};
    out->stream = open_target(out);
    if (out->stream != NULL)
        return true;
    bool is_ours = errno != EEXIST;
    error_set(err, "%s: cannot be created: %s", path, strerror(errno));
    release(out, is_ours);
    return false;
}

bool file_commit(struct file_output *out, struct error *err)
{
    errno = 0;
    bool ok = fflush(out->stream) == 0 && ferror(out->stream) == 0;
    /* On the disk before it has the target's name, so that not even a power failure leaves half a file there. */
    ok = ok && (out->temporary == NULL || os_store(out->stream));
    int reason = ok ? 0 : errno; /* os_store may leave a number in errno where it finds nothing to do */
    if (out->stream != stdout)
        ok = fclose(out->stream) == 0 && ok;
    if (ok && out->temporary != NULL)
        ok = os_rename(out->temporary, out->path);
    reason = reason != 0 ? reason : errno;
    if (!ok)
        error_set(err, "%s: cannot be written: %s", out->stream == stdout ? "standard output" : out->path,
                  reason != 0 ? strerror(reason) : "write error");
    if (!ok && out->stream == stdout)
        clearerr(stdout); /* it has been said */
    release(out, !ok);
    return ok;
}

void file_abandon(struct file_output *out)
{
    if (out->stream != stdout)
        fclose(out->stream);
    release(out, true);
}

/* --- budgets ------------------------------------------------------------------------------------------ */

struct budget budget_new(double limit, const char *advice)
{
    const double share = 0.75, fallback = 4e9, most = (double)(SIZE_MAX / 2); /* of which arrays can be */
    double machine = os_memory();
    double usual = machine > 0 ? share * machine : fallback;
    return (struct budget){fmin(limit > 0 ? limit : usual, most), 0, advice};
}

bool budget_has(const struct budget *b, double bytes, struct error *err)
{
    return b->taken + bytes <= b->limit ||
           error_set(err, "this needs %.1f MB more memory, but %.1f of %.1f MB are left%s", 1e-6 * bytes,
                     1e-6 * (b->limit - b->taken), 1e-6 * b->limit, b->advice);
}

bool budget_take(struct budget *b, double bytes, struct error *err)
{
    if (!budget_has(b, bytes, err))
        return false;
    b->taken += bytes;
    return true;
}
