/* test_hostile.c: whole runs of ./asbdpt on scenes that are meant to do harm. The verdict on each: exit status 0 or 1,
 * never a signal; a message unless it is 0; a picture, all of finite numbers, if it is 0; and no more than so much
 * time and memory, which is what SECURITY.md promises for scenes of up to a megabyte.
 *
 * Most scenes are random ones (random_scene.h) with evil numbers in them; the others are a kind of harm each, at its
 * full size. What random bytes make of test/fuzz/hostile.h is in the fuzzer's corpus. */
#define _POSIX_C_SOURCE 200809L

#define _XOPEN_SOURCE 700 /* getrusage's ru_maxrss */
#define _DARWIN_C_SOURCE  /* the same, on macOS */

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/mem.h"
#include "fuzz/targets.h"
#include "image/image.h"
#include "lab/files.h"
#include "helpers.h"
#include "random_scene.h"
#include "suites.h"

#ifdef __APPLE__
enum { RSS_UNIT = 1 }; /* bytes of ru_maxrss */
#else
enum { RSS_UNIT = 1024 };
#endif
enum { EVIL_SCENES = 300, SECONDS = 20, MEGABYTES = 512 };

static const char *const INTEGRATORS[] = {"pt", "lt", "bdpt", "asbdpt"};

/* The program, its working directory being `directory`, and its stderr there as well; the status of wait. */
static int run(const char *directory, const char *program, const char *const *arguments)
{
    int status = -1;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        struct rlimit cpu = {SECONDS, SECONDS + 1};
        if (chdir(directory) != 0 || setrlimit(RLIMIT_CPU, &cpu) != 0)
            _Exit(127);
        dup2(open("/dev/null", O_RDWR), 0);
        dup2(open("/dev/null", O_RDWR), 1);
        dup2(open("stderr.txt", O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
        execv(program, (char *const *)arguments);
        _Exit(127);
    }
    return child > 0 && waitpid(child, &status, 0) == child ? status : -1;
}

/* Is the picture of a run that ended well there, with nothing but numbers? */
static bool is_picture(const char *path)
{
    struct image img;
    struct error err;
    bool ok = image_read(path, NULL, &img, &err);
    for (int i = 0; ok && i < img.width * img.height * img.channels; i++)
        ok = isfinite(img.f32[i]);
    if (ok)
        image_free(&img);
    return ok;
}

/* Render scene.pbrt of the directory and judge what comes of it; the exit status. */
static int judge(struct test *t, const char *directory, const char *name, const char *integrator, int megabytes)
{
    char here[2048], program[2100], picture[400], log[400];
    snprintf(program, sizeof program, "%s/asbdpt", getcwd(here, sizeof here) != NULL ? here : ".");
    snprintf(picture, sizeof picture, "%s/out.pfm", directory);
    snprintf(log, sizeof log, "%s/stderr.txt", directory);
    const char *const arguments[] = {"asbdpt", "render", "scene.pbrt", "--res", "3x2", "--spp", "2", "-j1", "-o",
                                     "out.pfm", "--max-memory", ".4", "--integrator", integrator, NULL};
    struct rusage before, after;
    struct stat info;
    remove(picture);
    getrusage(RUSAGE_CHILDREN, &before);
    int status = run(directory, program, arguments);
    getrusage(RUSAGE_CHILDREN, &after);
    double seconds = (double)(after.ru_utime.tv_sec - before.ru_utime.tv_sec + after.ru_stime.tv_sec -
                              before.ru_stime.tv_sec);
    CHECK(t, WIFEXITED(status) && WEXITSTATUS(status) <= 1, "%s, %s: ended with wait status %d", name, integrator,
          status);
    CHECK(t, stat(log, &info) == 0 && info.st_size > 0, "%s, %s: not a word", name, integrator);
    CHECK(t, status != 0 || is_picture(picture), "%s, %s: no picture of finite numbers", name, integrator);
    CHECK(t, status == 0 || stat(picture, &info) != 0, "%s, %s: a picture of a failure", name, integrator);
    CHECK(t, seconds <= SECONDS, "%s, %s: %.0f s", name, integrator, seconds);
    double memory = (double)after.ru_maxrss * RSS_UNIT / 1048576;
    CHECK(t, memory <= megabytes, "%s, %s: %.0f MB", name, integrator, memory);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void put_scene(const char *directory, const char *text, size_t length)
{
    char path[400];
    snprintf(path, sizeof path, "%s/scene.pbrt", directory);
    write_bytes(path, text, length);
}

/* Random scenes that would be right but for a few of their numbers. */
static void test_evil(struct test *t, const char *directory)
{
    uint64_t first = 0, end = EVIL_SCENES;
    int rendered = 0;
    char top[1024], name[96];
    top_directory(top, sizeof top);
    bool all = !test_range(t, &first, &end);
    for (uint64_t i = first; i < end; i++) {
        struct random_scene scene = random_scene(i, top, true);
        put_scene(directory, scene.text, strlen(scene.text));
        free(scene.text);
        snprintf(name, sizeof name, "evil scene %llu (build/test --evil %llu)", (unsigned long long)i,
                 (unsigned long long)i);
        rendered += judge(t, directory, name, INTEGRATORS[i % 4], MEGABYTES) == 0;
    }
    CHECK(t, !all || rendered > EVIL_SCENES / 4, "only %d of %d scenes are rendered", rendered, EVIL_SCENES);
    printf("  %d evil scenes are rendered, the others refused\n", rendered);
}

/* --- harm of one kind --------------------------------------------------------------------------------------- */

/* A scene that says `line`, which may hold a %d for the number of the line, so many times. */
struct repetition {
    const char *name, *before, *line, *after;
    int times, status, megabytes; /* megabytes: 0: MEGABYTES */
};

static const struct repetition REPETITIONS[] = {
    {"named materials", "WorldBegin", "MakeNamedMaterial \"m%d\" \"string type\" \"matte\" NamedMaterial \"m%d\"",
     "WorldEnd", 200000, 0, 0},
    {"textures", "WorldBegin", "Texture \"t%d\" \"float\" \"constant\"", "WorldEnd", 200000, 0, 0},
    {"parameters of the material", "WorldBegin Material \"matte\"", "\"float p%d\" 1", "WorldEnd", 60000, 1, 0},
    {"changed materials", "WorldBegin Material \"uber\"", "Shape \"sphere\" \"float index\" 2", "WorldEnd", 30000, 0,
     0},
    {"unknown systems", "WorldBegin",
     "CoordinateSystem \"%d-1234567890-1234567890-1234567890-1234\" "
     "CoordSysTransform \"%d-0123456789-0123456789-0123456789-0123\"", "WorldEnd", 7300, 0, 0},
    {"a file without end", "", "Include \"/proc/self/pagemap\"", "WorldBegin WorldEnd", 1, 0, 0},
    {"parameters of the integrator", "Integrator \"bdpt\"", "\"integer p%d\" 1", "WorldBegin WorldEnd", 100000, 1, 0},
    {"the same parameter", "WorldBegin Shape \"sphere\"", "\"float radius\" 1", "WorldEnd", 100000, 1, 0},
    {"infinite lights", "WorldBegin", "LightSource \"infinite\"", "WorldEnd", 4096, 0, 0},
    {"infinite lights of one map", "WorldBegin", "LightSource \"infinite\" \"string mapname\" \"map.pfm\"", "WorldEnd",
     4096, 0, 0},
    {"lamps", "WorldBegin Translate 0 0 3 AreaLightSource \"diffuse\"",
     "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point P\" [ %d 0 0 0 1 0 0 0 1 ]", "WorldEnd", 100000, 0,
     0},
    {"open blocks", "WorldBegin", "AttributeBegin", "WorldEnd", 300000, 0, 0},
    {"nested objects", "WorldBegin ObjectBegin \"o0\" Shape \"sphere\"",
     "ObjectEnd ObjectBegin \"o\" ObjectInstance \"o0\" ObjectInstance \"o\"",
     "ObjectEnd ObjectInstance \"o\" WorldEnd", 10000, 0, 0},
    {"instances of nothing", "WorldBegin ObjectBegin \"o\" ObjectEnd", "ObjectInstance \"o\"", "WorldEnd", 100000,
     0, 0},
    {"unknown directives", "WorldBegin", "Shpae%d", "WorldEnd", 100000, 1, 0},
    {"unknown names", "WorldBegin", "NamedMaterial \"m%d\"", "WorldEnd", 20000, 0, 0},
    {"textures within textures", "WorldBegin Texture \"t\" \"float\" \"constant\"",
     "Texture \"t\" \"float\" \"scale\" \"texture tex1\" \"t\" \"texture tex2\" \"t\"", "WorldEnd", 30, 1, 0},
    {"includes of itself", "WorldBegin", "Include \"scene.pbrt\"", "WorldEnd", 1000, 1, 0},
    {"a film of 26 GB", "Film \"image\" \"integer xresolution\" 16384 \"integer yresolution\" 16384", "",
     "WorldBegin WorldEnd", 1, 0, 0}, /* --res makes it small */
    {"spheres in one place", "WorldBegin Translate 0 0 3 LightSource \"point\" \"point from\" [ 0 0 -3 ]",
     "Shape \"sphere\"", "WorldEnd", 60000, 0, 0},
    {"spheres around each other", "WorldBegin Translate 0 0 3 LightSource \"point\" \"point from\" [ 0 0 -3 ]",
     "Shape \"sphere\" \"float radius\" %d.5", "WorldEnd", 25000, 0, 0},
    {"triangles in one place",
     "WorldBegin Shape \"trianglemesh\" \"point P\" [ -9 -9 3 9 -9 3 0 9 3 ] \"integer indices\" [", "0 1 2",
     "] WorldEnd", 160000, 0, 0},
    {"lamps that rays pass", "WorldBegin Translate 0 0 3 Material \"none\" AreaLightSource \"diffuse\"",
     "Shape \"sphere\" \"float radius\" %d.5", "WorldEnd", 25000, 0, 0},
    {"interfaces around each other",
     "Integrator \"bdpt\" MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [ 1e-9 1e-9 1e-9 ] "
     "WorldBegin LightSource \"point\" Material \"none\"",
     "MediumInterface \"\" \"m\" Shape \"sphere\" \"float radius\" %d.5 MediumInterface \"m\" \"\" "
     "Shape \"sphere\" \"float radius\" %d.7", "WorldEnd", 7000, 0, 0},
    {"instances of lamps",
     "WorldBegin AreaLightSource \"diffuse\" ObjectBegin \"o\" Shape \"loopsubdiv\" \"integer levels\" 5 "
     "\"integer indices\" [ 0 1 2 0 2 3 0 3 1 1 3 2 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 0 0 1 ] ObjectEnd",
     "Translate 1 0 0 ObjectInstance \"o\"", "WorldEnd", 20000, 1, 0},
    {"instances of a million triangles", /* the last: the most memory of any run is what counts */
     "WorldBegin ObjectBegin \"o\" Shape \"loopsubdiv\" \"integer levels\" 9 "
     "\"integer indices\" [ 0 1 2 0 2 3 0 3 1 1 3 2 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 0 0 1 ] ObjectEnd",
     "Translate 1e-3 0 0 ObjectInstance \"o\"", "WorldEnd", 20000, 0, 1024},
};

/* A map of 40 MB once its tables are made. */
static void put_map(struct test *t, const char *directory)
{
    enum { WIDTH = 1024, HEIGHT = 512 };
    char path[400];
    struct error err;
    float *pixels = mem_alloc(WIDTH * HEIGHT, 3 * sizeof *pixels);
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        pixels[i] = (float)(i % 7);
    snprintf(path, sizeof path, "%s/map.pfm", directory);
    CHECK(t, image_write(path, WIDTH, HEIGHT, pixels, &err), "%s", err.text);
    free(pixels);
}

static void test_repetitions(struct test *t, const char *directory)
{
    for (size_t i = 0; i < sizeof REPETITIONS / sizeof REPETITIONS[0]; i++) {
        const struct repetition *r = &REPETITIONS[i];
        size_t room = strlen(r->before) + strlen(r->after) + 16 + (size_t)r->times * (strlen(r->line) + 24), n = 0;
        char *text = mem_alloc(room, 1);
        n += (size_t)snprintf(text, room, "%s\n", r->before);
        for (int k = 0; k < r->times; k++) {
            for (const char *p = r->line; *p != '\0'; p++)
                if (p[0] == '%' && p[1] == 'd')
                    n += (size_t)snprintf(text + n, room - n, "%d", k), p++;
                else
                    text[n++] = *p;
            text[n++] = '\n';
        }
        n += (size_t)snprintf(text + n, room - n, "%s\n", r->after);
        put_scene(directory, text, n);
        free(text);
        int status = judge(t, directory, r->name, INTEGRATORS[i % 4], r->megabytes > 0 ? r->megabytes : MEGABYTES);
        CHECK(t, status == r->status, "%s: exit status %d, not %d", r->name, status, r->status);
    }
}

void test_hostile_long(struct test *t)
{
    char directory[256];
    snprintf(directory, sizeof directory, "%s/hostile", test_tmp(t));
    CHECK(t, mkdir(directory, 0700) == 0, "%s cannot be made", directory);
    fuzz_prepare(directory);
    put_map(t, directory);
    test_evil(t, directory);
    test_repetitions(t, directory);
}

/* --- the suite fuzz ------------------------------------------------------------------------------------------- */

#define _DARWIN_C_SOURCE /* mkdtemp, on macOS */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/mem.h"
#include "fuzz/lists.h"
#include "fuzz/targets.h"
#include "helpers.h"
#include "suites.h"

/* The inputs of a target, packed: a line each. */
struct corpus {
    char *all;
    struct list_file part;
    int n;
};

static struct corpus read_corpus(struct test *t, const char *target)
{
    struct corpus c = {.all = text_of(t, "test/fuzz", "corpus.txt")};
    const char *at = c.all;
    while (list_next(&at, &c.part) && strcmp(c.part.name, target) != 0)
        ;
    for (size_t i = 0; strcmp(c.part.name, target) == 0 && i < c.part.size; i++)
        c.n += c.part.text[i] == '\n';
    return c;
}

/* Line k, packed as lists.h says. To be given to free(). */
static uint8_t *unpack(const struct corpus *c, int k, size_t *size)
{
    const char *p = c->part.text;
    for (; k > 0; k -= *p++ == '\n')
        ;
    size_t length = strcspn(p, "\n");
    uint8_t *out = mem_alloc(length + 1, 1);
    *size = list_bytes(p, length, out);
    return out;
}

static void run_input(const struct fuzz_target *target, const struct corpus *c, int k, const char *directory)
{
    size_t size;
    uint8_t *data = unpack(c, k, &size), *exact = mem_alloc(size, 1); /* a memory checker sees what is read beyond */
    memcpy(exact, data, size);
    target->run(exact, size, directory);
    free(exact);
    free(data);
}

/* How a process ends that runs the target on inputs first .. end - 1: 0 if well. */
static int run_alone(const struct fuzz_target *target, const struct corpus *c, int first, int end,
                     const char *directory)
{
    int status = -1;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        for (int i = first; i < end; i++)
            run_input(target, c, i, directory);
        _Exit(0);
    }
    return child > 0 && waitpid(child, &status, 0) == child ? status : -1;
}

/* All of them in one process, or, if that does not end well, each in its own. */
static void replay(struct test *t, const struct fuzz_target *target, const char *directory)
{
    struct corpus c = read_corpus(t, target->name);
    bool ok = CHECK(t, c.n > 0, "%s: no inputs", target->name) &&
              CHECK(t, run_alone(target, &c, 0, c.n, directory) == 0, "target %s breaks a promise", target->name);
    for (int i = 0; !ok && i < c.n; i++)
        CHECK(t, run_alone(target, &c, i, i + 1, directory) == 0, "%s: input of line %d", target->name, i + 1);
    free(c.all);
}

static void break_promise(const uint8_t *data, size_t size, const char *directory)
{
    (void)data, (void)size, (void)directory;
    abort();
}

/* fuzz: inputs that fuzzing found worth keeping: each must be read, or refused, as its list states. Every line
 * of test/fuzz/corpus.txt is an input. Targets, which test/fuzz/targets.h describes, end the process where they
 * do not: each has one of its own. */
void test_fuzz(struct test *t)
{
    static const struct fuzz_target BROKEN = {"png", break_promise};
    char directory[256];
    struct corpus c = read_corpus(t, "png");
    CHECK(t, run_alone(&BROKEN, &c, 0, 1, test_tmp(t)) != 0, "a target that breaks its promise is not noticed");
    free(c.all);
    /* Hundreds of pictures are written: in memory, where that can be had. */
    snprintf(directory, sizeof directory, "%s/fuzz-XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : test_tmp(t));
    if (!CHECK(t, mkdtemp(directory) != NULL, "%s cannot be made", directory))
        return;
    fuzz_prepare(directory);
    for (const struct fuzz_target *target = fuzz_targets; target->name != NULL; target++)
        replay(t, target, directory);
    CHECK(t, remove_tree(directory), "%s is left behind", directory);
}
