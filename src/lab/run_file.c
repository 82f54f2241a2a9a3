/* run_file.c: see run_file.h. */
#include "lab/run_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"

static const char COLUMNS[] = "spp,seconds,rmse,rmse8,relmse,mean_error,mean_noise,nonfinite";

bool run_write(const char *path, const char *key, const struct run *run, struct error *err)
{
    struct file_output f;
    if (!file_create(path, &f, err))
        return false;
    fprintf(f.stream, "# %s\n%s\n", key, COLUMNS);
    for (int i = 0; i < run->n; i++) {
        const struct run_step *s = &run->step[i];
        fprintf(f.stream, "%ld,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%ld\n", s->spp, s->seconds, s->rmse, s->rmse8,
                s->relmse, s->mean_error, s->mean_noise, s->nonfinite);
    }
    return file_commit(&f, err);
}

/* The text after `prefix`, or NULL when the text does not begin with it. */
static const char *after(const char *text, const char *prefix)
{
    size_t n = strlen(prefix);
    return text != NULL && strncmp(text, prefix, n) == 0 ? text + n : NULL;
}

static bool read_step(const char **text, struct run_step *s)
{
    int used = 0;
    if (sscanf(*text, "%ld,%lf,%lf,%lf,%lf,%lf,%lf,%ld%n", &s->spp, &s->seconds, &s->rmse, &s->rmse8, &s->relmse,
               &s->mean_error, &s->mean_noise, &s->nonfinite, &used) != 8 ||
        (*text)[used] != '\n')
        return false;
    *text += used + 1;
    return true;
}

bool run_read(const char *path, const char *key, int n_steps, struct run *out)
{
    memset(out, 0, sizeof *out);
    uint8_t *content;
    size_t size;
    if (!file_read(path, &content, &size, NULL))
        return false;
    const char *text = after(after(after(after(after((const char *)content, "# "), key), "\n"), COLUMNS), "\n");
    while (text != NULL && out->n < n_steps && read_step(&text, &out->step[out->n]))
        out->n++;
    bool ok = text != NULL && out->n == n_steps && *text == '\0';
    if (!ok)
        out->n = 0;
    free(content);
    return ok;
}
