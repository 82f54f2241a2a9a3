/* tables.c: see tables.h. */
#include "tables/tables.h"

#include <string.h>

const struct tables NO_TABLES = {.guide = {.n = 0}};

void tables_free(struct tables *t)
{
    regions_free(&t->eye);
    regions_free(&t->light);
    importance_free(&t->importance);
    guide_free(&t->guide);
    emission_free(&t->emission);
    pairs_free(&t->pairs);
    memset(t, 0, sizeof *t);
}
