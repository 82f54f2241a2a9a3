/* cmd_conform.c: asbdpt-lab conform: judge the pictures that another renderer made of the scenes of scenes/conform.
 * See conform.h and doc/conformance.md. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/mem.h"
#include "base/os.h"
#include "base/progress.h"
#include "lab/commands.h"
#include "lab/conform.h"
#include "lab/stats.h"

enum { MOST_SCENES = 64, MOST_PICTURES = 256, NAME = 64, LINE = 256, PATH = 4096 };

struct conform_options {
    const char *directory, *kit;
    double alpha;
    uint64_t seed;
};

#define AT(member) offsetof(struct conform_options, member)
static const struct option OPTIONS[] = {
    {"DIR", NULL, OPTION_TEXT, AT(directory), 1,
     .help = "a directory with pictures of each scene, NAME.pfm or NAME-1.pfm, NAME-2.pfm ... (or .exr), which differ "
             "in nothing but their seeds; four at least, if neighbouring pixels can share errors"},
    {"--kit", "DIR", OPTION_TEXT, AT(kit), .fallback = "ref/conform", .help = "the references, and list.txt"},
    {"--alpha", "P", OPTION_NUMBER, AT(alpha), 1e-12, 0.5, .fallback = "0.01",
     .help = "probability that of a correct renderer any scene of the table DIFFERS"},
    {"--seed", "N", OPTION_SEED, AT(seed), .help = "of the test's own random numbers"},
    {.name = NULL},
};

/* A scene of the kit, and what is there of it. */
struct scene_entry {
    char name[NAME], tags[LINE]; /* each tag with a blank before and behind it */
    struct side pictures;        /* n_batches 0: there are none */
    int repeated;                /* pictures that were there twice */
    struct judgement j;
    double fit[CONFORM_MOST];   /* p of each mistake; -1: it is not one that this scene shows */
};

struct kit {
    const struct conform_options *o;
    struct scene_entry scene[MOST_SCENES]; /* [n] */
    int n, n_there, n_unusable;            /* scenes; of these with pictures, and with some that cannot be judged */
    int n_found[3];                        /* of each finding */
    double level;                          /* of a scene */
    struct conform_sheet sheet;
};

/* --- reading ----------------------------------------------------------------------------------------- */

/* DIRECTORY/NAME and what follows it, which may be too long to be there. */
static const char *path_of(char path[PATH], const char *directory, const char *name, const char *rest)
{
    return snprintf(path, PATH, "%s/%s%s", directory, name, rest) < PATH ? path : "";
}

static bool read_list(struct kit *kit, struct error *err)
{
    char path[PATH], line[LINE - 1];
    FILE *f = os_open_input(path_of(path, kit->o->kit, "list.txt", ""));
    if (f == NULL)
        return error_set(err, "%s: cannot be opened; --kit names the directory of the references", path);
    while (kit->n < MOST_SCENES && fgets(line, sizeof line, f) != NULL) {
        struct scene_entry *s = &kit->scene[kit->n];
        int length = 0;
        line[strcspn(line, "\r\n")] = '\0';
        if (line[0] == '#' || sscanf(line, "%63s%n", s->name, &length) != 1)
            continue;
        snprintf(s->tags, sizeof s->tags, "%s ", line + length);
        kit->n++;
    }
    fclose(f);
    return kit->n > 0 || error_set(err, "%s: names no scene", path);
}

/* The pictures of a scene: NAME.pfm, NAME-1.pfm and so on, or with .exr. */
static bool read_pictures(const char *directory, struct scene_entry *s, struct error *err)
{
    static const char *const extension[] = {"pfm", "exr"};
    char *file[MOST_PICTURES], path[PATH], rest[16];
    int n = 0;
    bool ok = true, kind[2] = {false, false};
    for (int e = 0, last = 0; e < 2; e++, last = 0)
        for (int k = 0; n < MOST_PICTURES && k <= MOST_PICTURES; k++) {
            snprintf(rest, sizeof rest, k > 0 ? "%d.%s" : ".%.0d%s", -k, extension[e]);
            if (!file_exists(path_of(path, directory, s->name, rest)))
                continue;
            if (k > last + 1)
                ok = error_set(err, "%s: there is no picture %d before it", path, last + 1);
            last = k;
            kind[e] = true;
            file[n++] = mem_copy_text(path);
        }
    if (kind[0] && kind[1])
        ok = error_set(err, "%s/%s: there are .pfm and .exr; which are meant?", directory, s->name);
    ok = ok && (n == 0 || side_read((const char *const *)file, n, false, NULL, &s->pictures, err));
    if (ok && n > 0)
        s->repeated = conform_distinct(&s->pictures);
    s->pictures.name = s->name;
    for (int i = 0; i < n; i++)
        free(file[i]);
    return ok;
}

/* --- judging ----------------------------------------------------------------------------------------- */

static bool judge_scene(struct kit *kit, struct scene_entry *s, struct error *err)
{
    struct conform_references *r = mem_alloc(1, sizeof *r);
    *r = conform_row(&kit->sheet, (int)(s - kit->scene), strstr(s->tags, " closed ") != NULL);
    bool ok = (s->pictures.width == r->right.width && s->pictures.height == r->right.height) ||
              error_set(err, "%s: the pictures are %dx%d, the reference %dx%d; all must have the same size", s->name,
                        s->pictures.width, s->pictures.height, r->right.width, r->right.height);
    if (ok) {
        s->j = conform_judge(&s->pictures, r, kit->level, kit->o->seed);
        kit->n_found[s->j.finding]++;
    }
    for (int i = 0; CONFORM_MISTAKES[i].words != NULL; i++)
        s->fit[i] = ok && s->j.finding == FINDS_DIFFERENCE ? conform_fit_p(&s->pictures, r, i) : -1;
    conform_free(r);
    free(r);
    return ok;
}

/* --- what is said ------------------------------------------------------------------------------------ */

static void print_scene(const struct scene_entry *s)
{
    static const char *const words[3] = {"agrees", "cannot tell", "DIFFERS"};
    const struct verdict *v = &s->j.verdict;
    char count[40];
    int n = s->pictures.pixels.n_batches;
    snprintf(count, sizeof count, "%d%s", n, n < CONFORM_FEW ? " (blocks)" : "");
    printf("%-14s %-11s %8.4f +- %-8.2g %-8.2g %s", s->name, count, v->ratio, v->ratio_error, v->p,
           words[s->j.finding]);
    if (s->j.why[0] != '\0')
        printf(": %s", s->j.why);
    if (s->repeated > 0 && v->n > 0 && v->ratio > 0)
        printf(" (%d more pictures are identical: is the seed used?)", s->repeated);
    putchar('\n');
}

static bool differs(const struct scene_entry *s) { return s->j.finding == FINDS_DIFFERENCE; }

/* Every tag of which most scenes differ, where its first scene stands. */
static void print_tags(const struct kit *kit)
{
    const struct scene_entry *end = kit->scene + kit->n;
    for (const struct scene_entry *first = kit->scene; first < end; first++)
        for (const char *tag = first->tags; *(tag += strspn(tag, " ")) != '\0'; tag += strcspn(tag, " ")) {
            char word[LINE];
            int with = 0, differ = 0, before = 0;
            snprintf(word, sizeof word, " %.*s ", (int)strcspn(tag, " "), tag);
            for (const struct scene_entry *s = kit->scene; s < end; s++)
                if (strstr(s->tags, word) != NULL) {
                    before += s < first;
                    with += s->pictures.pixels.n_batches > 0;
                    differ += differs(s);
                }
            if (before == 0 && 2 * differ > with)
                printf("of the scenes with%sdiffer %d of %d\n", word, differ, with);
        }
}

/* Is this scene one that differs, of which nothing has been said yet, and that the mistake explains? */
static bool explains(const struct kit *kit, int scene, int mistake, const bool *said)
{
    return differs(&kit->scene[scene]) && !said[scene] && (mistake < 0 || kit->scene[scene].fit[mistake] >= kit->level);
}

/* The mistake that explains most of the scenes that differ, then the one that explains most of the others, and so on;
 * at last those that none explains. */
static void print_mistakes(const struct kit *kit)
{
    bool said[MOST_SCENES] = {false};
    for (int best = 0, most = 1; most > 0;) {
        best = -1;
        most = 0;
        for (int m = 0; CONFORM_MISTAKES[m].words != NULL; m++) {
            int fits = 0;
            for (int i = 0; i < kit->n; i++)
                fits += explains(kit, i, m, said);
            best = fits > most ? m : best;
            most = fits > most ? fits : most;
        }
        int n = 0;
        for (int i = 0; i < kit->n; i++)
            if (explains(kit, i, best, said)) {
                if (n++ == 0)
                    printf("%s explains", best >= 0 ? CONFORM_MISTAKES[best].words : "no mistake that was tried");
                printf("%s %s", n > 1 ? "," : "", kit->scene[i].name);
                said[i] = true;
            }
        fputs(n > 0 ? "\n" : "", stdout);
    }
}

static void print_summary(const struct kit *kit)
{
    printf("%d scenes: %d agree, %d differ, of %d it cannot tell\n", kit->n_there, kit->n_found[FINDS_AGREEMENT],
           kit->n_found[FINDS_DIFFERENCE], kit->n_found[FINDS_DOUBT]);
    printf("a correct renderer has a scene that DIFFERS with probability %g; each is tested at the level %.2g\n",
           kit->o->alpha, kit->level);
    for (int i = 0, n = 0; kit->n_there < kit->n && i <= kit->n; i++)
        if (i == kit->n)
            putchar('\n');
        else if (kit->scene[i].pictures.pixels.n_batches == 0)
            printf("%s %s", n++ == 0 ? "no pictures of" : ",", kit->scene[i].name);
    print_tags(kit);
    print_mistakes(kit);
}

static bool conform(struct kit *kit, struct error *err)
{
    if (!read_list(kit, err))
        return false;
    for (int i = 0; i < kit->n; i++) {
        if (!read_pictures(kit->o->directory, &kit->scene[i], err)) {
            say_line("asbdpt: %s: not judged: %s", kit->scene[i].name, err->text);
            batches_free(&kit->scene[i].pictures.pixels);
            kit->scene[i].pictures = (struct side){.name = kit->scene[i].name};
            kit->n_unusable++;
        }
        kit->n_there += kit->scene[i].pictures.pixels.n_batches > 0;
    }
    if (kit->n_there == 0 && kit->n_unusable > 0)
        return error_set(err, "%s: no picture can be judged", kit->o->directory);
    if (kit->n_there == 0)
        return error_set(err, "%s: holds no picture of the kit's scenes, such as %s.pfm or %s-1.pfm", kit->o->directory,
                         kit->scene[0].name, kit->scene[0].name);
    char path[PATH];
    if (!conform_sheet_read(path_of(path, kit->o->kit, "references.pfm", ""), kit->n, &kit->sheet, err))
        return false;
    struct progress bar;
    int n_judged = 0;
    progress_start(&bar, false);
    kit->level = stats_sidak(kit->o->alpha, 1.0 / kit->n_there);
    printf("%-14s %-11s %-20s %-8s %s\n", "scene", "pictures", "ratio of the means", "p", "verdict");
    for (struct scene_entry *s = kit->scene; s < kit->scene + kit->n; s++) {
        if (s->pictures.pixels.n_batches == 0)
            continue;
        progress_update(&bar, (double)n_judged++ / kit->n_there);
        bool ok = judge_scene(kit, s, err);
        progress_end(&bar);
        if (!ok)
            return false;
        print_scene(s);
    }
    print_summary(kit);
    return true;
}

static int run(void *options)
{
    struct error err;
    struct kit *kit = mem_alloc(1, sizeof *kit);
    kit->o = options;
    bool ok = conform(kit, &err);
    bool any = kit->n_found[FINDS_DIFFERENCE] > 0, unusable = kit->n_unusable > 0;
    for (int i = 0; i < kit->n; i++)
        batches_free(&kit->scene[i].pictures.pixels);
    free(kit->sheet.pixels);
    free(kit);
    return !ok ? fail(&err) : any || unusable ? EXIT_JOB : EXIT_OK;
}

const struct command command_conform = {
    "conform", "judge another renderer by its pictures of known scenes", {"DIR [options]"}, OPTIONS,
    sizeof(struct conform_options), run, true, "conform out/conform"};
