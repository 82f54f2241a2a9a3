/* chosen.c: see chosen.h. */
#include "render/chosen.h"

#include <string.h>

static const char *const RACED[RUNNERS] = {"race_all", "race_quarter", "race_path_tracer", "race_one_point"};

void chosen_numbers(const struct prepared *p, struct chosen_number out[CHOSEN_NUMBERS])
{
    const struct numbers *n = &p->numbers;
    const struct runner *winner = &p->runner[p->winner];
    int draws = n->path_pixels > 0;
    const struct chosen_number numbers[] = {
        {"draws_first_hit", draws * n->draws[FIRST_HIT]}, {"draws_after", draws * n->draws[LATER_HIT]},
        {"light_points_first_hit", n->light_points}, {"pixels_per_light_path", n->path_pixels},
        {"iterations_per_light_path", numbers_every(n)}, {"regions", p->tables->regions.n}};
    int used = (int)(sizeof numbers / sizeof *numbers);
    memset(out, 0, CHOSEN_NUMBERS * sizeof *out); /* a NULL name ends the list */
    memcpy(out, numbers, sizeof numbers);
    for (int i = 0; i < RUNNERS; i++)
        if (p->runner[i].price > 0 && winner->price > 0) /* unless the race was cancelled */
            out[used++] = (struct chosen_number){RACED[i], runner_cost(&p->runner[i]) / runner_cost(winner)};
}
