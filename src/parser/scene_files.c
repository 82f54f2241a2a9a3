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
    char *path = find(f, name);
    enum os_kind kind = os_kind_of(path);
    struct error why;
    bool fits = kind != OS_FILE || budget_has(f->memory, (double)length_of(path), &why);
    if (symbols_find(&f->paths, path) < 0)
        symbols_add(&f->paths, path, 0);
    if (fits && (kind == OS_FILE || kind == OS_NOTHING)) /* that there is nothing, reading will say */
        return path;
    if (fits)
        error_set(&why, "scenes name files, not %s", kind == OS_DIRECTORY ? "directories" : "devices or pipes");
    error_set(err, "%s: cannot be read: %s", path, why.text);
    free(path);
    return NULL;
}

bool scene_files_count(struct scene_files *f, uint64_t content, double bytes, struct error *err)
{
    *f->content = hash_combine(*f->content, content);
    return budget_take(f->memory, bytes, err);
}

static char *counted(struct scene_files *f, char *text, size_t size, struct error *err)
{
    if (text == NULL || scene_files_count(f, hash_content(text, size), (double)size, err))
        return text;
    free(text);
    return NULL;
}

char *scene_files_read(struct scene_files *f, const char *path, size_t *size, struct error *err)
{
    char *text = text_read(path, size, err);
    return counted(f, text, *size, err);
}

char *scene_files_copy(struct scene_files *f, const char *path, const char *given, size_t size, struct error *err)
{
    if (size >= INT32_MAX) {
        error_set(err, "%s: cannot read the text: it is larger than 2 GiB", path);
        return NULL;
    }
    char *text = mem_alloc(size + 1, 1);
    memcpy(text, given, size);
    return counted(f, text, size, err);
}
