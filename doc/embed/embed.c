/* embed.c: the library in a program: a render that ends after two seconds and says what it cost.
 *
 *     make lib && cc -std=c99 -Isrc/library doc/embed/embed.c build/libasbdpt.a -lm -lpthread -o out/embed-c
 *     out/embed-c scenes/cornell-box.pbrt out/box.png */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "asbdpt.h"

/* Called before every sample: a clock is quick enough. */
static int late(void *context)
{
    const time_t *end = context;
    return time(NULL) >= *end ? ASBDPT_END_BLOCK : ASBDPT_CONTINUE;
}

int main(int argc, char **argv)
{
    asbdpt *r = asbdpt_new();
    time_t end = time(NULL) + 2;
    int width, height;
    if (argc != 3 || asbdpt_set(r, "--integrator", "asbdpt") || asbdpt_set(r, "-P", "race=off") ||
        asbdpt_open(r, argv[1]) || asbdpt_render(r, 0, NULL, late, &end) || asbdpt_save(r, argv[2]) ||
        asbdpt_size(r, &width, &height)) {
        fprintf(stderr, "embed: %s\n", argc == 3 ? asbdpt_message(r) : "embed SCENE.pbrt PICTURE.png");
        asbdpt_free(r);
        return EXIT_FAILURE;
    }
    fputs(asbdpt_warnings(r), stderr);
    printf("%dx%d pixels, %g samples of each\n%s", width, height, asbdpt_samples(r), asbdpt_statistics(r));
    asbdpt_free(r);
    return EXIT_SUCCESS;
}
