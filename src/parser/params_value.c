/* params_value.c: parameters whose values need computing: colours from spectra, names of files. See params.h. */
#include "parser/params.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "parser/spectrum.h"

char *path_join(const char *directory, const char *name)
{
    if (name[0] == '/' || directory[0] == '\0')
        return mem_copy_text(name);
    size_t n = strlen(directory);
    char *path = mem_alloc(n + strlen(name) + 2, 1);
    memcpy(path, directory, n);
    if (directory[n - 1] != '/')
        path[n++] = '/';
    strcpy(path + n, name);
    return path;
}

char *params_file(struct params *p, const char *name, struct place *at)
{
    const char *file = params_text(p, name, PARAM_STRING, at);
    return file != NULL ? path_join(p->directory, file) : NULL;
}

/* Wavelength and value pairs of an .spd file: numbers, with comments from # to the end of the line. Errors in it
 * are shown at the place in that file. */
static rgb rgb_from_file(struct params *p, const struct param *item)
{
    rgb colour = rgb_black();
    struct error inner;
    size_t size;
    char *path = path_join(p->directory, p->string[item->first]), *text = text_read(path, &size, &inner);
    if (text == NULL) {
        params_fail(p, param_value_place(item, 0), "%s", inner.text);
        free(path);
        return colour;
    }
    struct arena arena = {NULL, NULL};
    struct input input = {path, text, text + size, item->place};
    struct lexer l = lexer_start(&input, &arena, p->messages);
    double *number = NULL;
    size_t n = 0, capacity = 0;
    struct token t = {0};
    bool ok = lexer_next(&l, &t);
    for (; ok && t.kind == TOKEN_NUMBER; ok = lexer_next(&l, &t)) {
        number = mem_grow(number, &capacity, n + 1, sizeof *number);
        number[n++] = t.number;
    }
    if (!ok)
        p->failed = true;
    else if (t.kind != TOKEN_END || n < 2 || n % 2 != 0)
        params_fail(p, t.place,
                    "a spectrum file holds pairs of numbers, wavelength in nm and value, and nothing else");
    else
        colour = spectrum_from_samples((double(*)[2])number, (int)(n / 2));
    free(number);
    arena_free(&arena);
    free(text);
    free(path);
    return colour;
}

/* How many numbers a colour of this type has; 0: pairs. */
static int colour_numbers(enum param_type type)
{
    if (type == PARAM_RGB || type == PARAM_XYZ)
        return 3;
    return type == PARAM_BLACKBODY ? 2 : 0;
}

static rgb rgb_from_numbers(enum param_type type, double *x, int n)
{
    switch ((int)type) {
    case PARAM_RGB: return rgb_make(x[0], x[1], x[2]);
    case PARAM_XYZ: return spectrum_from_xyz(x[0], x[1], x[2]);
    case PARAM_BLACKBODY: return spectrum_blackbody(x[0], x[1]);
    default: return spectrum_from_samples((double(*)[2])x, n / 2);
    }
}

/* Numbers of a colour can be summed, and those of a file are not checked one by one, so what comes out is. */
static bool colour_usable(rgb c)
{
    return fabs(c.r) <= NUMBER_MAX && fabs(c.g) <= NUMBER_MAX && fabs(c.b) <= NUMBER_MAX;
}

rgb params_rgb(struct params *p, const char *name, rgb fallback)
{
    const unsigned types = 1u << PARAM_RGB | 1u << PARAM_XYZ | 1u << PARAM_BLACKBODY | 1u << PARAM_SPECTRUM;
    int n;
    const struct param *item;
    params_list(p, name, types, 1, &n, &item);
    if (item == NULL)
        return fallback;
    rgb colour;
    int want = colour_numbers(item->type);
    if (item->is_text ? item->n != 1 : (want > 0 && item->n != want) || (want == 0 && item->n % 2 != 0)) {
        static const char *const WANTED[] = {"pairs of wavelength and value, or one file name", "",
                                             "two values, temperature and scale", "three values"};
        params_fail(p, item->place, "parameter \"%s\" wants %s, but there are %d", name, WANTED[want], item->n);
        return fallback;
    }
    if (item->is_text)
        colour = rgb_from_file(p, item);
    else
        colour = rgb_from_numbers(item->type, p->number + item->first, item->n);
    if (colour_usable(colour))
        return colour;
    params_fail(p, item->place, "parameter \"%s\" gives the colour (%g %g %g); its numbers go up to %g here", name,
                colour.r, colour.g, colour.b, NUMBER_MAX);
    return fallback;
}
