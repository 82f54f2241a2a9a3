/* plan.c: see plan.h. */
#include "lab/plan.h"

#include <stdio.h>
#include <string.h>

#include "image/zlib.h"

bool plan_set_spp(struct plan *p, long first, long last, struct error *err)
{
    p->n_steps = 0;
    for (long n = first; n < last; n *= 2) {
        if (p->n_steps >= PLAN_MAX_STEPS - 1)
            return error_set(err, "more than %d doublings of the samples from %ld to %ld", PLAN_MAX_STEPS - 1, first,
                             last);
        p->spp[p->n_steps++] = n;
    }
    p->spp[p->n_steps++] = last;
    return true;
}

bool plan_set_methods(struct plan *p, const char *list, struct error *err)
{
    bool ok = methods_read(list, &p->methods, err);
    p->n_compared = p->methods.n;
    return ok;
}

bool plan_add_sweep(struct plan *p, const char *list, struct error *err)
{
    struct methods more;
    if (!methods_read(list, &more, err))
        return false;
    if (p->methods.n + more.n > METHODS_MAX)
        return error_set(err, "%s: too many methods", list);
    for (int i = 0; i < more.n; i++)
        if (methods_find(&p->methods, more.item[i].text) < 0)
            p->methods.item[p->methods.n++] = more.item[i];
    return true;
}

int plan_seeds(const struct plan *p, int method) { return method < p->n_compared ? p->n_seeds : 1; }

uint64_t plan_seed(const struct plan *p, int method, int i)
{
    const char *text = p->methods.item[method].text;
    uint64_t number = checksum_crc32(0, (const uint8_t *)text, strlen(text)) % 999983;
    return 1000000000 * p->seed + 1000 * number + (uint64_t)i; /* no two sets have a seed in common */
}

bool plan_create(const struct plan *p, const char *name, struct file_output *out, struct error *err)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", p->directory, name);
    return file_create(path, out, err);
}

void plan_write_command(FILE *f, const struct plan *p)
{
    fprintf(f, "    ./asbdpt-lab %s -o %s", p->command, p->directory);
    for (int i = 0; i < p->n_scenes; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s", p->scene[i]);
        error_clean(path);
        fprintf(f, "%s %s", i % 3 == 0 ? " \\\n       " : "", path);
    }
    fputs("\n\n", f);
}
