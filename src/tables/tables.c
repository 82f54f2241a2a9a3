/* tables.c: see tables.h. */
#include "tables/tables.h"

#include <stdlib.h>
#include <string.h>

const struct tables NO_TABLES = {.regions = {.n = 1}};

void tables_free(struct tables *t)
{
    regions_free(&t->regions);
    free(t->use);
    free(t->vertices);
    table_free(&t->guide);
    table_free(&t->pairs);
    table_free(&t->emission);
    memset(t, 0, sizeof *t);
}
