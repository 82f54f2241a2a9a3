/* tables.c: see tables.h. */
#include "tables/tables.h"

#include <stdlib.h>
#include <string.h>

const struct tables NO_TABLES = {.guide = {.n = 0}};

void tables_free(struct tables *t)
{
    regions_free(&t->eye);
    regions_free(&t->light);
    free(t->importance.E);
    free(t->importance.vertices);
    guide_free(&t->guide);
    emission_free(&t->emission);
    free(t->pairs.h);
    memset(t, 0, sizeof *t);
}
