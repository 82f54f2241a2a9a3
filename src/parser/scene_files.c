/* scene_files.c: see scene_files.h. */
#include "parser/scene_files.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/file.h"
#include "base/mem.h"
#include "base/os.h"

/* Bytes of a file; 0 if it cannot be opened, or is none. */
static uint64_t length_of(const char *path)
{
    uint64_t length = 0;
    FILE *f = os_open_input(path);
    if (f != NULL) {
        os_kind_of_stream(f, &length);
        fclose(f);
    }
    return length;
}

char *text_read(const char *path, size_t *size, struct error *err)
{
    uint8_t *data = NULL;
    bool fits = length_of(path) < INT32_MAX, ok = fits && file_read(path, &data, size, NULL);
    int reason = fits && !ok ? errno : 0;
    if (ok && *size < INT32_MAX)
        return (char *)data;
    free(data);
    error_set(err, "%s: cannot %s the file: %s", path, reason != 0 && reason != EISDIR ? "open" : "read",
              reason != 0 ? strerror(reason) : "it is larger than 2 GiB");
    return NULL;
}

/* The path of a name; to be given to free(). If nothing is there, its backslashes may be meant as slashes. */
static char *find(const struct scene_files *f, const char *name)
{
    char *given = file_beside(f->scene_path, name), *slashed = mem_copy_text(given);
    for (char *c = slashed + strlen(slashed) - strlen(name); *c != '\0'; c++)
        *c = *c == '\\' ? '/' : *c;
    bool meant = os_kind_of(given) == OS_NOTHING && os_kind_of(slashed) != OS_NOTHING;
    free(meant ? given : slashed);
    return meant ? slashed : given;
}

char *scene_files_path(struct scene_files *f, const char *name, struct error *err)
{
    if (f->full) {
        error_set(err, "%s: not read after too many or too large files", name);
        return NULL;
    }
    char *path = find(f, name);
    enum os_kind kind = os_kind_of(path);
    if (symbols_find(&f->paths, path) < 0)
        symbols_add(&f->paths, path, 0);
    if (kind == OS_FILE || kind == OS_NOTHING) /* that there is nothing, reading will say */
        return path;
    error_set(err, "%s: cannot be read: scenes name files, not %s", path,
              kind == OS_DIRECTORY ? "directories" : "devices or pipes");
    free(path);
    return NULL;
}

/* A file costs its size where it is new, else what it takes. */
static bool count(struct scene_files *f, uint64_t content, uint64_t size, uint64_t taken, struct error *err)
{
    char name[24];
    snprintf(name, sizeof name, "%016llx", (unsigned long long)content);
    *f->content = hash_combine(*f->content, content);
    bool known = symbols_find(&f->known, name) >= 0;
    if (!known)
        symbols_add(&f->known, name, 0);
    *(known ? &f->again : &f->first) += known ? taken : size;
    f->full |= f->again > MAX_READ_AGAIN && f->again / READ_AGAIN_PER_BYTE > f->first;
    return !f->full || error_set(err, "with this file, more than %d MB have been read again; use ObjectInstance",
                     MAX_READ_AGAIN >> 20);
}

bool scene_files_count(struct scene_files *f, uint64_t content, uint64_t size, struct error *err)
{
    return count(f, content, size, size, err);
}

char *scene_files_read(struct scene_files *f, const char *path, size_t *size, struct error *err)
{
    char *text = text_read(path, size, err);
    if (text == NULL || scene_files_count(f, hash_content(text, *size), *size, err))
        return text;
    free(text);
    return NULL;
}

bool scene_files_picture(struct scene_files *f, const struct image *img, uint64_t tables, struct error *err)
{
    uint64_t taken = image_bytes(img) + tables, paid = (uint64_t)img->file_size * PICTURE_BYTES_PER_BYTE;
    f->unpacked += taken > paid ? taken - paid : 0;
    f->full |= f->unpacked > MAX_UNPACKED;
    if (f->full)
        return error_set(err, "this and other images of so small files take more than %d MB; store them as PFM",
                         MAX_UNPACKED >> 20);
    return count(f, img->content, img->file_size, taken, err);
}
