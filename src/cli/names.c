/* names.c: see names.h. */
#include "cli/names.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/os.h"

struct name {
    char *label; /* for messages: who gives it, and as what; owned */
    enum option_file use;
    bool standard;         /* input or output */
    char *path;            /* links followed; owned */
    struct os_identity at; /* of the file, or of the directory where it would be */
    const char *entry;     /* in that directory, part of path; "": the file is there */
};

static void locate(struct name *n, const char *path)
{
    n->standard = strcmp(path, "-") == 0;
    n->path = file_follow(path);
    if (n->path == NULL) /* links in a circle: opening it says so */
        n->path = mem_copy_text(path);
    n->entry = "";
    n->at = n->standard ? os_identify_stream(n->use == FILE_READ ? stdin : stdout) : os_identify(n->path);
    if (n->standard || n->at.kind != OS_NOTHING)
        return;
    const char *slash = os_last_separator(n->path);
    char *directory = file_beside(n->path, ".");
    n->at = os_identify(directory);
    n->at.kind = OS_NOTHING;
    n->entry = slash != NULL ? slash + 1 : n->path;
    free(directory);
}

static void release(struct name *n)
{
    free(n->label);
    free(n->path);
}

static bool same_file(const struct name *a, const struct name *b)
{
    if (a->at.number == 0 || b->at.number == 0)
        return strcmp(a->path, b->path) == 0;
    return a->at.device == b->at.device && a->at.number == b->at.number && strcmp(a->entry, b->entry) == 0;
}

static bool clash(const struct name *a, const struct name *b)
{
    if (a->standard && b->standard)
        return (a->use == FILE_READ) == (b->use == FILE_READ);
    if (a->use == b->use && a->use != FILE_WRITTEN)
        return false;
    return a->at.kind != OS_OTHER && b->at.kind != OS_OTHER && same_file(a, b);
}

bool names_add(struct names *all, enum option_file use, const char *what, const char *path, struct error *err)
{
    size_t size = strlen(what) + strlen(path) + 2;
    struct name n = {.label = mem_alloc(size, 1), .use = use};
    snprintf(n.label, size, "%s %s", what, path);
    locate(&n, path);
    for (int i = 0; i < all->n; i++)
        if (clash(&all->item[i], &n)) {
            error_usage(err, "%s and %s are the same file", all->item[i].label, n.label);
            release(&n);
            return false;
        }
    all->item = mem_append(all->item, (size_t)all->n, sizeof *all->item);
    all->item[all->n++] = n;
    return true;
}

bool names_add_options(struct names *all, const struct option *table, void *target, struct error *err)
{
    bool ok = true;
    for (const struct option *o = table; ok && o != NULL; o = options_next(o)) {
        int n = 0;
        const char *const *text = o->file != FILE_NONE ? options_texts(o, target, &n) : NULL;
        for (int i = 0; ok && i < n; i++)
            ok = names_add(all, o->file, o->name, text[i], err);
    }
    return ok;
}

void names_free(struct names *all)
{
    for (int i = 0; i < all->n; i++)
        release(&all->item[i]);
    free(all->item);
    memset(all, 0, sizeof *all);
}

bool names_same(const char *a, const char *b)
{
    struct name x = {.use = FILE_KEPT}, y = {.use = FILE_KEPT};
    locate(&x, a);
    locate(&y, b);
    bool same = same_file(&x, &y);
    release(&x);
    release(&y);
    return same;
}
