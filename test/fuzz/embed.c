/* embed.c: all that the library does, once, in a program of its own:
 *
 *     embed SCENE DIR        into DIR a picture in each format, a part and a checkpoint, which it continues; prints the
 *                            statistics' number of samples. Status 1 with a message where a call fails
 *     embed SCENE -n N       opens, renders and closes N times; prints the kilobytes that the process has held at most
 *                            after each quarter of them
 *
 * test/run/embed.sh runs it, and with functions that fail (inject.c) under the address sanitizer. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/os.h"
#include "library/asbdpt.h"

static int status;

static int failed(asbdpt *r)
{
    fprintf(stderr, "embed: %s\n", asbdpt_message(r));
    status = 1;
    return 1;
}

static asbdpt *open_scene(const char *scene)
{
    asbdpt *r = asbdpt_new();
    if (asbdpt_set(r, "--res", "8x8") || asbdpt_set(r, "--nthreads", "2") || asbdpt_set(r, "--integrator", "asbdpt") ||
        asbdpt_set(r, "-P", "guide=on") || asbdpt_open(r, scene) || asbdpt_keep_error(r))
        failed(r);
    return r;
}

static void see(void *context, const struct asbdpt_path *path)
{
    (void)context;
    (void)path;
}

static void save_all(asbdpt *r, const char *directory)
{
    static const char *const NAMES[] = {"a.pfm", "a.exr", "a.png", "a.ppm", "a.part"};
    char path[512];
    for (int i = 0; i < 5; i++) {
        snprintf(path, sizeof path, "%s/%s", directory, NAMES[i]);
        if (asbdpt_save(r, path))
            failed(r);
    }
}

static void do_all(const char *scene, const char *directory)
{
    float pixels[3 * 8 * 8];
    char path[512];
    asbdpt *r = open_scene(scene), *again = NULL;
    snprintf(path, sizeof path, "%s/a.checkpoint", directory);
    if (status == 0 && (asbdpt_observe(r, see, NULL) || asbdpt_render(r, 2, NULL, NULL, NULL) ||
                        asbdpt_save_checkpoint(r, path) || asbdpt_render(r, 2, NULL, NULL, NULL) ||
                        asbdpt_read(r, pixels)))
        failed(r);
    if (status == 0)
        save_all(r, directory);
    if (status == 0) {
        again = open_scene(scene);
        if (status == 0 && (asbdpt_load_checkpoint(again, path) || asbdpt_render(again, 2, NULL, NULL, NULL)))
            failed(again);
        if (status == 0)
            puts(strstr(asbdpt_statistics(again), "\"spp_done\"") != NULL ? "4 samples" : "no statistics");
    }
    asbdpt_free(again);
    asbdpt_free(r);
}

int main(int argc, char **argv)
{
    if (argc == 3)
        do_all(argv[1], argv[2]);
    long n = argc == 4 ? 4 * (strtol(argv[3], NULL, 10) / 4) : 0;
    for (long i = 0; i < n && status == 0; i++) {
        asbdpt *r = open_scene(argv[1]);
        if (asbdpt_render(r, 1, NULL, NULL, NULL))
            failed(r);
        asbdpt_free(r);
        if ((i + 1) % (n / 4) == 0)
            printf("%.0f\n", os_peak_memory() / 1024);
    }
    return status;
}
