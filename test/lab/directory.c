/* directory.c: see directory.h. */
#include "lab/directory.h"

#include <stdlib.h>

#include "base/mem.h"
#include "base/os.h"

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
