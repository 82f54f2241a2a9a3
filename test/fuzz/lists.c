/* lists.c: see lists.h. */
#define _POSIX_C_SOURCE 200809L

#include "fuzz/lists.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/mem.h"

enum { PATH = 4096 };

bool list_next(const char **at, struct list_file *out)
{
    static const char MARK[] = "\n== ";
    const char *name = strstr(*at, MARK);
    if (name == NULL)
        return false;
    name += strlen(MARK);
    size_t length = strcspn(name, " !\n"), line = strcspn(name, "\n");
    snprintf(out->name, sizeof out->name, "%.*s", (int)length, name);
    out->packed = strncmp(name + length, " packed", 7) == 0;
    out->text = name + line + (name[line] != '\0');
    const char *next = strstr(out->text - 1, MARK);
    *at = next != NULL ? next : out->text + strlen(out->text);
    out->size = (size_t)(*at - out->text) + (next != NULL) - (name[length] == '!');
    return true;
}

size_t list_bytes(const char *text, size_t size, uint8_t *out)
{
    size_t n = 0;
    for (const char *p = text; p < text + size; p++)
        if (*p == '\\' && p + 3 < text + size) {
            out[n++] = (uint8_t)((p[1] - '0') * 64 + (p[2] - '0') * 8 + (p[3] - '0'));
            p += 3;
        } else if (*p != '\n') {
            out[n++] = (uint8_t)*p;
        }
    return n;
}

static bool make_file(const char *directory, const struct list_file *f, struct error *err)
{
    char path[PATH];
    uint8_t *bytes = mem_alloc(f->size + 1, 1);
    size_t n = f->packed ? list_bytes(f->text, f->size, bytes) : f->size;
    if (!f->packed)
        memcpy(bytes, f->text, n);
    snprintf(path, sizeof path, "%s/%s", directory, f->name);
    FILE *out = fopen(path, "wb");
    bool ok = out != NULL && fwrite(bytes, 1, n, out) == n;
    ok = out != NULL && fclose(out) == 0 && ok;
    free(bytes);
    return ok || error_set(err, "%s: cannot be written", path);
}

/* Where links are not allowed, as in a WASI sandbox to a path from the root. */
static bool copy_file(const char *path, const char *to, const char *name, struct error *err)
{
    struct list_file f = {.packed = false};
    uint8_t *data;
    if (snprintf(f.name, sizeof f.name, "%s", name) >= (int)sizeof f.name)
        return error_set(err, "%s: a name that is too long", path);
    if (!file_read(path, &data, &f.size, err))
        return false;
    f.text = (const char *)data;
    bool ok = make_file(to, &f, err);
    free(data);
    return ok;
}

static bool unpack_file(const char *from, const char *to, const char *name, struct error *err)
{
    char path[PATH], link[PATH];
    const char *end = strrchr(name, '.');
    uint8_t *data;
    size_t size;
    if (snprintf(path, sizeof path, "%s/%s", from, name) >= PATH ||
        snprintf(link, sizeof link, "%s/%s", to, name) >= PATH)
        return error_set(err, "%s/%s: a path that is too long", from, name);
    if (end == NULL || strcmp(end, ".txt") != 0)
        return symlink(path, link) == 0 || errno == EEXIST || copy_file(path, to, name, err);
    if (!file_read(path, &data, &size, err))
        return false;
    const char *at = (const char *)data; /* file_read puts a zero byte behind it */
    struct list_file f;
    bool ok = true;
    while (ok && list_next(&at, &f))
        ok = make_file(to, &f, err);
    free(data);
    return ok;
}

bool list_unpack(const char *from, const char *to, struct error *err)
{
    char here[PATH], folder[PATH];
    if (getcwd(here, sizeof here) == NULL || snprintf(folder, sizeof folder, "%s/%s", here, from) >= PATH ||
        (mkdir(to, 0777) != 0 && errno != EEXIST))
        return error_set(err, "%s: cannot be made", to);
    DIR *d = opendir(folder);
    bool ok = d != NULL || error_set(err, "%s: cannot be opened; run the tests at the top of the tree", folder);
    for (struct dirent *e = ok ? readdir(d) : NULL; e != NULL && ok; e = readdir(d))
        if (e->d_name[0] != '.')
            ok = unpack_file(folder, to, e->d_name, err);
    if (d != NULL)
        closedir(d);
    return ok;
}
