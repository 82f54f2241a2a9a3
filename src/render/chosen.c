/* chosen.c: see chosen.h. */
#include "render/chosen.h"

#include <stdio.h>
#include <string.h>

#include "integrators/race.h"

void chosen_numbers(const struct prepared *p, struct chosen_number out[CHOSEN_NUMBERS])
{
    const struct numbers *n = &p->numbers;
    const struct runner *winner = &p->runner[p->winner];
    int draws = n->path_pixels > 0;
    const struct chosen_number numbers[] = {
        {"draws_first_hit", draws * n->draws[FIRST_HIT]}, {"draws_after", draws * n->draws[LATER_HIT]},
        {"light_points_first_hit", n->light_points}, {"pixels_per_light_path", n->path_pixels},
        {"iterations_per_light_path", numbers_every(n)}, {"regions", p->tables != NULL ? p->tables->regions.n : 0}};
    int used = (int)(sizeof numbers / sizeof *numbers);
    memset(out, 0, CHOSEN_NUMBERS * sizeof *out); /* an empty name ends the list */
    memcpy(out, numbers, sizeof numbers);
    for (int i = 0; i < RUNNERS; i++)
        if (p->runner[i].price > 0 && winner->price > 0 && !race_blind(&p->runner[i])) { /* 0: no race, or cancelled */
            snprintf(out[used].name, sizeof out->name, "race_%s", runner_name(i));
            out[used++].value = runner_cost(&p->runner[i]) / runner_cost(winner);
        }
}
