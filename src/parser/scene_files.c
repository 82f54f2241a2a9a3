/* scene_files.c: see scene_files.h. */
#include "parser/scene_files.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/bits.h"
#include "base/file.h"
#include "base/os.h"

char *scene_files_path(const struct scene_files *f, const char *name, struct error *err)
{
    char *path = file_beside(f->scene_path, name);
    enum os_kind kind = os_kind_of(path);
    if (kind == OS_FILE || kind == OS_NOTHING) /* that there is nothing, reading will say */
        return path;
    error_set(err, "%s: cannot be read: scenes name files, not %s", path,
              kind == OS_DIRECTORY ? "directories" : "devices or pipes");
    free(path);
    return NULL;
}

bool scene_files_count(struct scene_files *f, uint64_t content, uint64_t bytes, struct error *err)
{
    char name[24];
    snprintf(name, sizeof name, "%016llx", (unsigned long long)content);
    *f->content = hash_combine(*f->content, content);
    bool known = symbols_find(&f->known, name) >= 0;
    if (!known)
        symbols_add(&f->known, name, 0);
    *(known ? &f->again : &f->first) += bytes;
    return f->again <= MAX_READ_AGAIN || f->again / READ_AGAIN_PER_BYTE <= f->first ||
           error_set(err, "with this file, more than %d MB have been read again; use ObjectInstance",
                     MAX_READ_AGAIN >> 20);
}
