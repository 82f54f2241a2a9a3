/* method.c: the memory that every method's threads need; see method.h. */
#include "integrators/method.h"

#include <stdlib.h>

struct workspace *workspaces_new(int n, int max_depth)
{
    struct workspace *work = mem_alloc((size_t)n, sizeof *work);
    size_t vertices = (size_t)max_depth + 2;
    for (int i = 0; i < n; i++) {
        work[i].eye = mem_alloc(vertices, sizeof *work[i].eye);
        work[i].light = mem_alloc(vertices, sizeof *work[i].light);
    }
    return work;
}

void workspaces_free(struct workspace *work, int n)
{
    for (int i = 0; i < n; i++) {
        arena_free(&work[i].arena);
        free(work[i].eye);
        free(work[i].light);
    }
    free(work);
}
