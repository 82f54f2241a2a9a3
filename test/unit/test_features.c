/* test_features.c: the scenes of scenes/features, one for each element of the scene format.
 *
 * Each is loaded, must give the warnings of its "# warn: " lines and no others, and is rendered by path tracing and by
 * BDPT, which must agree and not be black.
 */
#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "agree.h"
#include "helpers.h"
#include "parser/parser.h"
#include "suites.h"

static const char FEATURES[] = "scenes/features";
enum { MAX_SCENES = 200, NAME = 64, TEXT = 512, SIZE = 12, SPP = 4, BATCHES = 10, TILE = 6 };

/* What a scene's warnings are compared with. */
struct expected {
    struct test *test;
    const char *name;
    FILE *file; /* the scene, before its next "# warn: " */
};

/* The rest of the next line "# warn: ..." of the comment at the head; false if there is none. */
static bool next_warning(FILE *f, char text[TEXT])
{
    char line[TEXT];
    while (f != NULL && fgets(line, sizeof line, f) != NULL && line[0] == '#')
        if (strncmp(line, "# warn: ", 8) == 0) {
            line[strcspn(line, "\n")] = '\0';
            strcpy(text, line + 8);
            return true;
        }
    return false;
}

static void hear(void *context, bool is_error, const char *text)
{
    struct expected *e = context;
    char wanted[TEXT];
    bool any = !is_error && next_warning(e->file, wanted);
    CHECK(e->test, any && strstr(text, wanted) != NULL, "%s: warned \"%s\", expected \"%s\"", e->name, text,
          any ? wanted : "nothing");
}

static bool load(struct test *t, const char *name, struct scene *scene)
{
    char path[TEXT], listed[TEXT], missed[TEXT];
    struct error err = {.text = ""};
    snprintf(path, sizeof path, "%s/%s", FEATURES, name);
    struct expected expected = {t, name, fopen(scene_path(t, path, listed), "r")};
    struct message_sink sink = {hear, &expected};
    bool ok = CHECK(t, parse_scene(scene_path(t, path, listed), NULL, scene, &sink, &err), "%s", err.text);
    CHECK(t, !next_warning(expected.file, missed), "%s: no warning \"%s\"", name, missed);
    if (expected.file != NULL)
        fclose(expected.file);
    if (!ok)
        return false;
    CHECK(t, scene->integrator != NULL && scene->film_filename != NULL, "%s: no integrator or no file name", name);
    scene->width = scene->height = SIZE;
    scene_prepare(scene);
    return true;
}

static void check_scene(struct test *t, const char *name, int number)
{
    struct scene scene;
    double error;
    if (!load(t, name, &scene))
        return;
    uint64_t seed = 2000 + 2 * (uint64_t)number;
    struct batches pt = render_batches(t, &scene, "pt", 0, 2 * SPP, BATCHES, TILE, seed);
    struct batches bdpt = render_batches(t, &scene, "bdpt", 0, SPP, BATCHES, TILE, seed + 1);
    CHECK(t, batches_mean(&pt, &error) > 0.01, "%s is black", name);
    check_agree(t, &bdpt, &pt, false, 1, "%s: bdpt against pt", name);
    batches_free(&pt);
    scene_free(&scene);
}

static int by_name(const void *a, const void *b) { return strcmp(a, b); }

void test_features(struct test *t)
{
    static char name[MAX_SCENES][NAME];
    char directory[TEXT] = "";
    int n = 0;
    if (scene_path(t, "scenes/features/stage.inc", directory) == directory)
        *strrchr(directory, '/') = '\0'; /* where the lists lie as files */
    DIR *d = opendir(directory);
    for (struct dirent *e = d != NULL ? readdir(d) : NULL; e != NULL; e = readdir(d)) {
        size_t length = strlen(e->d_name);
        if (length > 5 && length < NAME && strcmp(e->d_name + length - 5, ".pbrt") == 0 && n < MAX_SCENES)
            strcpy(name[n++], e->d_name);
    }
    if (d != NULL)
        closedir(d);
    CHECK(t, n >= 40, "only %d scenes in %s: run the tests at the top of the tree", n, FEATURES);
    qsort(name, (size_t)n, NAME, by_name);
    for (int i = 0; i < n; i++)
        check_scene(t, name[i], i);
}
