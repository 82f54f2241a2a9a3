/* parser_limits.c: the bounds of every parameter; what a scene may repeat, and how often: copies, files, pictures,
 * errors. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/near.h"
#include "base/os.h"
#include "base/rng.h"
#include "helpers.h"
#include "parser/parse.h"
#include "parser/parser.h"
#include "parser/scene_files.h"
#include "parser_parts.h"

/* What is no parameter of a shape is none of its material either, of whatever kind that is: no copy is made. What is
 * one makes one. */
static void check_copies(struct test *t)
{
    static const char *const KINDS[] = {"matte", "mirror", "glass", "metal", "plastic", "substrate", "uber",
                                        "translucent", "subsurface", "kdsubsurface", "disney", "mix", "none", "matte"};
    enum { LAST = sizeof KINDS / sizeof KINDS[0] - 1, SHAPES = 20 };
    for (int k = 0; k <= LAST; k++) {
        char text[4 * TEXT];
        struct scene s;
        int n = snprintf(text, sizeof text, "WorldBegin MakeNamedMaterial \"a\" \"string type\" \"matte\"\nMaterial "
                         "\"%s\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"a\"\n", KINDS[k]);
        for (int i = 0; i < SHAPES; i++)
            n += snprintf(text + n, sizeof text - (size_t)n, "Shape \"sphere\" \"float %s\" .%d\n",
                          k == LAST ? "sigma" : "nosuchthing", i + 1);
        snprintf(text + n, sizeof text - (size_t)n, "WorldEnd");
        if (!scene_from_text(t, text, &s))
            continue;
        CHECK(t, k == LAST ? s.n_materials > SHAPES : s.n_materials <= 3, "%s: %d materials", KINDS[k], s.n_materials);
        scene_free(&s);
    }
}

/* A matrix may be given times any number. */
static void check_matrices(struct test *t, struct rng *r)
{
    static const char THINGS[] = "Shape \"sphere\" Shape \"trianglemesh\" \"integer indices\" [0 1 2] "
                                 "\"point P\" [0 0 0 1 0 0 0 1 0] WorldEnd";
    for (int i = 0; i < 50; i++) {
        struct scene s[2];
        struct transform m = random_affine(r);
        double w = i % 3 == 0 ? -0.5 : exp(8 * rng_uniform(r) - 4);
        for (int k = 0; k < 2; k++) {
            char text[4 * TEXT];
            int n = snprintf(text, sizeof text, "WorldBegin %s [", i % 2 ? "Transform" : "ConcatTransform");
            for (int c = 0; c < 16; c++)
                n += snprintf(text + n, sizeof text - (size_t)n, "%.17g ", m.m[c % 4][c / 4] * (k == 0 ? 1 : w));
            snprintf(text + n, sizeof text - (size_t)n, "] %s", THINGS);
            if (!scene_from_text(t, text, &s[k]))
                return;
        }
        for (int prim = 0; prim < 2; prim++) {
            float lo[2][3], hi[2][3];
            for (int k = 0; k < 2; k++)
                shape_bounds(&s[k].geo, prim ? FIRST_QUADRIC : 0, lo[k], hi[k]);
            for (int k = 0; k < 3; k++)
                CHECK(t, fabsf(lo[0][k] - lo[1][k]) + fabsf(hi[0][k] - hi[1][k]) < 1e-5f * (hi[0][k] - lo[0][k] + 1),
                      "a matrix times %g: %s from %g to %g, not from %g to %g", w, prim ? "sphere" : "mesh",
                      (double)lo[1][k], (double)hi[1][k], (double)lo[0][k], (double)hi[0][k]);
        }
        scene_free(&s[0]);
        scene_free(&s[1]);
    }
}

/* A world of n times `line`, in which "@" stands for another way each to write "", is parsed. */
static bool parse_repeated(struct test *t, const char *line, int n, const struct parse_options *options,
                           struct error *err)
{
    char path[TEXT];
    size_t room = 64 + (size_t)n * (strlen(line) + 2 * (size_t)n);
    char *text = mem_alloc(room, 1);
    size_t used = (size_t)sprintf(text, "WorldBegin\n");
    for (int i = 0; i < n; i++) {
        for (const char *p = line; *p != '\0'; p++)
            if (*p != '@')
                text[used++] = *p;
            else
                for (int k = 0; k < i; k++)
                    used += (size_t)sprintf(text + used, "./");
        text[used++] = '\n';
    }
    used += (size_t)sprintf(text + used, "WorldEnd\n");
    snprintf(path, sizeof path, "%s/repeated.pbrt", test_tmp(t));
    write_bytes(path, text, used);
    free(text);
    struct scene s;
    bool ok = parse_scene(path, options, &s, NULL, err);
    if (ok)
        scene_free(&s);
    return ok;
}

/* What comes first of a file, and a comment that makes it a megabyte. */
static void put_megabyte(struct test *t, const char *name, const char *begin)
{
    enum { MEGABYTE = 1 << 20 };
    char path[TEXT], *text = mem_alloc(MEGABYTE, 1);
    memset(text, '#', MEGABYTE);
    memcpy(text, begin, strlen(begin));
    snprintf(path, sizeof path, "%s/%s", test_tmp(t), name);
    write_bytes(path, text, MEGABYTE);
    free(text);
}

static void check_infinite(struct test *t)
{
    static const char LINE[] = "LightSource \"infinite\"";
    struct error err = {.text = ""};
    CHECK(t, parse_repeated(t, LINE, 4096, NULL, &err), "%s", err.text);
    CHECK(t, !parse_repeated(t, LINE, 4097, NULL, &err) && strstr(err.text, "more than 4096 infinite lights") != NULL,
          "%s", err.text);
}

/* All that a file can make large asks for memory, at its place. Of 20 MB the first takes less than all, and twenty
 * more; 4 GB would do for them. */
static void check_memory(struct test *t)
{
    static const char *const LINE[] = {
        "Include \"@text\"",
        "LightSource \"point\" \"spectrum I\" \"@spectrum\"",
        "Shape \"plymesh\" \"string filename\" \"@mesh\"",
        "Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"@picture\"",
        "LightSource \"infinite\" \"string mapname\" \"@map\"",
        "Translate 1 0 0 Shape \"loopsubdiv\" \"integer levels\" 7 \"integer indices\" [ 0 1 2 ] "
        "\"point P\" [ 0 0 0 1 0 0 0 1 0 ]",
        "Translate 1 0 0 Shape \"curve\" \"string basis\" \"bspline\" \"float width\" 1e-6 "
        "\"point P\" [ 0 0 0 1 2 0 1 0 0 2 2 0 2 0 0 3 2 0 3 0 0 4 2 0 4 0 0 5 2 0 5 0 0 6 2 0 6 0 0 7 2 0 7 0 0 "
        "8 2 0 8 0 0 9 2 0 9 0 0 10 2 0 10 0 0 9 2 0 9 0 0 8 2 0 8 0 0 7 2 0 7 0 0 6 2 0 6 0 0 5 2 0 5 0 0 4 2 0 "
        "4 0 0 3 2 0 3 0 0 2 2 0 2 0 0 1 2 0 ]",
        "ObjectBegin \"o\" Shape \"loopsubdiv\" \"integer levels\" 8 \"integer indices\" [ 0 1 2 ] "
        "\"point P\" [ 0 0 0 1 0 0 0 1 0 ] ObjectEnd",
        "AttributeBegin AreaLightSource \"diffuse\" ObjectBegin \"o\" Shape \"loopsubdiv\" \"integer levels\" 5 "
        "\"integer indices\" [ 0 1 2 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 ] ObjectEnd AttributeEnd "
        "ObjectInstance \"o\" Translate 1 0 0 ObjectInstance \"o\" Translate 1 0 0 ObjectInstance \"o\"",
    };
    put_megabyte(t, "text", "");
    put_megabyte(t, "spectrum", "500 1\n");
    put_megabyte(t, "picture", "P5 1024 1023 255 ");
    put_megabyte(t, "map", "P5 256 256 255 ");
    put_megabyte(t, "mesh",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 3 0 1 2 ");
    for (size_t i = 0; i < sizeof LINE / sizeof LINE[0]; i++) {
        static const struct parse_options little = {.max_memory = 20e6}, much = {.max_memory = 4e9};
        struct error err = {.text = ""};
        CHECK(t, parse_repeated(t, LINE[i], 1, &little, &err) && parse_repeated(t, LINE[i], 21, &much, &err), "%s: %s",
              LINE[i], err.text);
        CHECK(t, !parse_repeated(t, LINE[i], 21, &little, &err) && strstr(err.text, "repeated.pbrt:") != NULL &&
                     strstr(err.text, "of 20.0 MB are left; --max-memory raises the limit") != NULL,
              "%s: %s", LINE[i], err.text);
    }
}

/* A file that is larger than what is left is not read at all. */
static void check_large_file(struct test *t)
{
    static const struct parse_options little = {.max_memory = 0.9e6};
    struct error err = {.text = ""};
    put_megabyte(t, "text", "");
    CHECK(t, !parse_repeated(t, "Include \"text\"", 1, &little, &err) &&
                 strstr(err.text, "text: cannot be read: this needs 1.0 MB more memory, but 0.9 of 0.9 MB") != NULL,
          "%s", err.text);
}

/* Of many shapes each is known. */
static void check_twice(struct test *t)
{
    enum { SHAPES = 300 };
    char *text = mem_alloc(SHAPES + 2, 64);
    struct hearing *heard = mem_alloc(1, sizeof *heard);
    struct message_sink sink = {hear_message, heard};
    struct scene s;
    struct error err = {.text = ""};
    char path[TEXT];
    size_t n = (size_t)sprintf(text, "WorldBegin\n");
    for (int i = 0; i <= SHAPES; i++)
        n += (size_t)sprintf(text + n, "Shape \"sphere\" \"float radius\" %d\n", i % SHAPES + 1);
    n += (size_t)sprintf(text + n, "WorldEnd\n");
    snprintf(path, sizeof path, "%s/twice.pbrt", test_tmp(t));
    write_bytes(path, text, n);
    if (CHECK(t, parse_scene(path, NULL, &s, &sink, &err), "%s", err.text)) {
        CHECK(t, s.geo.n_quadrics == SHAPES && heard->warnings.n == 1 &&
                     strstr(heard->warnings.text[0], "twice.pbrt:302:1: this shape equals that of line 2, in") != NULL,
              "%d spheres, and %d warnings: %s", s.geo.n_quadrics, heard->warnings.n, heard->warnings.text[0]);
        scene_free(&s);
    }
    free(heard);
    free(text);
}

/* Letters by which a differs from b, by the definition: case apart, one that is changed, left out or put in. */
static int letters(const char *a, const char *b)
{
    if (*a == '\0' || *b == '\0')
        return (int)(strlen(a) + strlen(b));
    int changed = letters(a + 1, b + 1) + ((*a | 32) != (*b | 32)), left_out = letters(a + 1, b) + 1;
    int put_in = letters(a, b + 1) + 1, least = left_out < put_in ? left_out : put_in;
    return changed < least ? changed : least;
}

/* The nearest of random names, of few letters, is found where it is near enough. */
static void check_near(struct test *t, struct rng *r)
{
    enum { NAMES = 4, LONGEST = 8 };
    int found = 0;
    for (int round = 0; round < 2000; round++) {
        char name[NAMES + 1][LONGEST + 1] = {""};
        struct near near;
        int best = 0;
        for (int i = 0; i <= NAMES; i++)
            for (int n = 1 + (int)(rng_uniform(r) * LONGEST), k = 0; k < n; k++)
                name[i][k] = "abA"[(int)(3 * rng_uniform(r))];
        near = near_start(name[NAMES]);
        for (int i = 0; i < NAMES; i++) {
            best = letters(name[NAMES], name[i]) < letters(name[NAMES], name[best]) ? i : best;
            near_try(&near, name[i]);
        }
        size_t n = strlen(name[NAMES]);
        bool close = letters(name[NAMES], name[best]) <= (n < 3 ? 0 : n < 6 ? 1 : 2);
        const char *wanted = close ? name[best] : NULL;
        found += close;
        CHECK(t, near.name == wanted, "of %s, %s, %s, %s near %s is %s", name[0], name[1], name[2], name[3],
              name[NAMES], near.name != NULL ? near.name : "none");
    }
    CHECK(t, found > 200 && found < 1800, "%d of 2000 names were found", found);
}

/* A name of megabytes is not read once more for each that it is compared with, nor are those. */
static void check_near_long(struct test *t)
{
    enum { LONG = 1 << 23, NAMES = 20000 };
    char *name = mem_alloc(LONG + 1, 1);
    memset(name, 'a', LONG);
    double start = os_cpu_seconds();
    struct near long_one = near_start(name), short_one = near_start(name + LONG - NEAR_LONGEST);
    for (int i = 0; i < NAMES; i++) {
        near_try(&long_one, name + i % 2);
        near_try(&short_one, name + i % 2);
    }
    double seconds = os_cpu_seconds() - start;
    CHECK(t, long_one.name == NULL && short_one.name == NULL && seconds < 1, "%d names of %d letters: %.1f s", NAMES,
          LONG, seconds);
    near_try(&short_one, name + LONG - NEAR_LONGEST);
    CHECK(t, short_one.name != NULL, "a name of %d letters is none", NEAR_LONGEST);
    free(name);
}

/* Megabytes of names, and of others that are near, take no longer than any others. */
static void check_mistakes(struct test *t)
{
    enum { NAMES = 15000, ROOM = 1 << 22 };
    static const char *const LINES[] = {"MakeNamedMaterial \"wood-%025d\" \"string type\" \"matte\"\n",
                                        "NamedMaterial \"wood.%025d\"\n", "Shape \"sphere\" \"float radii%025d\" 1\n"};
    char *text = mem_alloc(ROOM, 1);
    int n = snprintf(text, ROOM, "WorldBegin\n");
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < NAMES; i++)
            n += snprintf(text + n, (size_t)(ROOM - n), LINES[k], i);
    snprintf(text + n, (size_t)(ROOM - n), "WorldEnd\n");
    struct scene s;
    double start = os_cpu_seconds();
    if (scene_from_text(t, text, &s))
        scene_free(&s);
    double seconds = os_cpu_seconds() - start;
    CHECK(t, n < ROOM - 100 && seconds < 5, "%d mistakes take %.1f s", 2 * NAMES, seconds);
    free(text);
}

/* No more errors than are told are looked for. */
static void check_many_errors(struct test *t)
{
    struct hearing *heard = mem_alloc(1, sizeof *heard);
    struct message_sink sink = {hear_message, heard};
    struct error err = {.text = ""};
    char path[TEXT];
    parse_repeated(t, "Shpae", 1000, NULL, &err);
    snprintf(path, sizeof path, "%s/repeated.pbrt", test_tmp(t));
    struct scene s;
    CHECK(t, !parse_scene(path, NULL, &s, &sink, &err), "unknown directives are accepted");
    CHECK(t, strstr(heard->errors.text[heard->errors.n - 1], "and 17 more errors") != NULL, "the last error is %s",
          heard->errors.text[heard->errors.n - 1]);
    free(heard);
}

/* A scene names files: not standard input, no pipe and no device. */
static void check_no_files(struct test *t)
{
#if !defined _WIN32 && !defined __wasi__ /* which have no pipes among the files */
    static const char *const NAMES[][2] = {
        {"fifo", "scenes name files, not devices or pipes"}, {"/dev/null", "scenes name files, not devices or pipes"},
        {"directory", "scenes name files, not directories"}, {"-", "No such file"}};
    char path[TEXT], line[TEXT];
    snprintf(path, sizeof path, "%s/fifo", test_tmp(t));
    CHECK(t, mkfifo(path, 0600) == 0, "cannot make a pipe");
    snprintf(path, sizeof path, "%s/directory", test_tmp(t));
    CHECK(t, os_make_directory(path), "cannot make a directory");
    static const char *const LINES[] = {"Include \"%s\"", "LightSource \"infinite\" \"string mapname\" \"%s\"",
                                        "LightSource \"point\" \"spectrum I\" \"%s\"",
                                        "Shape \"plymesh\" \"string filename\" \"%s\""};
    for (int i = 0; i < 16; i++) {
        struct error err = {.text = ""};
        snprintf(line, sizeof line, LINES[i / 4], NAMES[i % 4][0]);
        CHECK(t, !parse_repeated(t, line, 1, NULL, &err) && strstr(err.text, NAMES[i % 4][1]) != NULL, "%s: %s", line,
              err.text);
    }
#else
    (void)t;
#endif
}

/* --- bounds ----------------------------------------------------------------------------------------------- */

/* One number, in a directive before the world or in it; is it refused for its bounds? */
static bool refused(struct test *t, const char *directive, bool before, const char *type, const struct field *f,
                    double value)
{
    char path[TEXT], text[2 * TEXT], out_of_bounds[TEXT], large[TEXT];
    struct error err = {.text = ""};
    struct scene s;
    int n = snprintf(text, sizeof text, "%s%s \"%s\" \"%s %s\" [ %.17g ]\n%sWorldEnd\n", before ? "" : "WorldBegin ",
                     directive, type, f->kind == FIELD_INTEGER ? "integer" : "float", f->name, value,
                     before ? "WorldBegin " : "");
    snprintf(path, sizeof path, "%s/bound.pbrt", test_tmp(t));
    write_bytes(path, text, (size_t)n);
    if (parse_scene(path, NULL, &s, NULL, &err))
        scene_free(&s);
    snprintf(out_of_bounds, sizeof out_of_bounds, "\"%s\" is ", f->name);
    snprintf(large, sizeof large, "too large for \"%s\"", f->name); /* for any parameter */
    return (strstr(err.text, out_of_bounds) != NULL && strstr(err.text, "it must be") != NULL) ||
           strstr(err.text, large) != NULL;
}

/* The numbers of these types, within the bounds that the tables give them, and just beyond. Returns how many. */
static int check_types(struct test *t, const char *directive, bool before, const struct object_type *types)
{
    int n = 0;
    for (; types->name != NULL; types++)
        for (const struct field *f = types->fields; f->name != NULL; f++) {
            bool whole = f->kind == FIELD_INTEGER;
            if (!(f->low < f->high) || (!whole && f->kind != FIELD_NUMBER && f->kind != FIELD_FLOAT_TEXTURE))
                continue;
            double below = whole ? f->low - 1 : f->low > 0 ? f->low / 2 : 1.01 * f->low - 1e-3;
            double above = whole ? f->high + 1 : 1.01 * f->high;
            CHECK(t, refused(t, directive, before, types->name, f, below) &&
                         refused(t, directive, before, types->name, f, above),
                  "%s \"%s\": \"%s\" may be %g or %g", directive, types->name, f->name, below, above);
            CHECK(t, !refused(t, directive, before, types->name, f, f->low) &&
                         !refused(t, directive, before, types->name, f, f->high),
                  "%s \"%s\": \"%s\" may not be %g or %g", directive, types->name, f->name, f->low, f->high);
            n++;
        }
    return n;
}

static void check_bounds(struct test *t)
{
    struct object_type types[MOST_TYPES];
    int n = check_types(t, "Texture \"t\" \"spectrum\"", false, TEXTURE_TYPES);
    for (const struct directive *d = OPTION_DIRECTIVES; d->name != NULL; d++)
        n += d->types != NULL ? check_types(t, d->name, true, d->types) : 0;
    for (const struct directive *d = LIGHT_DIRECTIVES; d->name != NULL; d++)
        n += check_types(t, d->name, false, d->types);
    parse_material_types(types);
    n += check_types(t, "Material", false, types);
    parse_shape_types(types);
    n += check_types(t, "Shape", false, types);
    CHECK(t, n > 80, "only %d bounds", n);
}

void check_parser_limits(struct test *t)
{
    check_bounds(t);
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 0, 0);
    check_copies(t);
    check_matrices(t, &r);
    check_infinite(t);
    check_memory(t);
    check_large_file(t);
    check_twice(t);
    check_near(t, &r);
    check_near_long(t);
    check_mistakes(t);
    check_many_errors(t);
    check_no_files(t);
}
