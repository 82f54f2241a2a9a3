/* importance.c: see importance.h. */
#include "tables/importance.h"

#include <stdlib.h>

void importance_free(struct importance *importance)
{
    free(importance->E.x);
    free(importance->vertices.x);
    memset(importance, 0, sizeof *importance);
}
