/* demo.c: see demo.h. */
#include "lab/demo.h"

#include <stdlib.h>

#include "lab/pictures.h"

static double shown_blocks(const struct scene_results *s, int method)
{
    int k = s->plan->scale > 1 ? s->plan->scale : 1;
    float *small = sheet_shrink(s->image[method], s->width * k, s->height * k, k);
    double rmse8 = compare_shown_blocks(small, s->reference.pixels, s->width, s->height);
    free(small);
    return rmse8;
}

void demo_draw(const struct results *r, struct sheet *sheet)
{
    const struct scene_results *s = &r->scene[0];
    const struct plan *p = r->plan;
    int scale = p->scale > 1 ? p->scale : 1, width = s->width * scale, height = s->height * scale, n = p->methods.n;
    int k = width < COLUMN_WIDTH ? COLUMN_WIDTH / width : 1;
    char cost[100];
    sheet_init(sheet, (n + 1) * (width * k + COLUMN_GAP) + COLUMN_GAP, COLUMN_LABEL + height * k + 2 * COLUMN_GAP,
               SHEET_PAPER);
    for (int i = 0; i < n; i++) {
        const struct run_step *step = &s->run[i][0].step[0];
        snprintf(cost, sizeof cost, "%ld spp, %.1f s; in 8x8 %.1f", step->spp, step->value[Q_SECONDS],
                 shown_blocks(s, i));
        draw_column(sheet, i, p->methods.item[i].text, "error", step->value[Q_RMSE8], cost, s->image[i], width, height,
                    k);
    }
    if (scale > 1)
        snprintf(cost, sizeof cost, "%.14s; %d x %d in one", s->reference.origin, scale, scale);
    else
        snprintf(cost, sizeof cost, "%.14s", s->reference.origin);
    draw_column(sheet, n, "reference", "noise", s->reference.noise8, cost, s->reference.pixels, s->width, s->height,
                k * scale);
}

void demo_print(FILE *f, const struct results *r)
{
    const struct scene_results *s = &r->scene[0];
    for (int i = 0; i < r->plan->methods.n; i++) {
        const struct run_step *step = &s->run[i][0].step[0];
        fprintf(f, "%-8s %6ld spp %8.2f s of CPU   rmse8 %.3f   of 8x8 pixels %.3f\n", r->plan->methods.item[i].text,
                step->spp, step->value[Q_SECONDS], step->value[Q_RMSE8], shown_blocks(s, i));
    }
}
