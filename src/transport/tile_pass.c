/* tile_pass.c: see tile_pass.h. */
#include "transport/tile_pass.h"

#include <stdlib.h>

struct workspace *workspaces_new(int n, int max_depth)
{
    struct workspace *work = mem_alloc((size_t)n, sizeof *work);
    for (int i = 0; i < n; i++)
        work[i].eye = mem_alloc((size_t)max_depth + 2, sizeof *work[i].eye);
    return work;
}

void workspaces_free(struct workspace *work, int n)
{
    for (int i = 0; i < n; i++) {
        arena_free(&work[i].arena);
        free(work[i].eye);
        pool_free(&work[i].pool);
    }
    free(work);
}
