/* main.c: asbdpt's command line: pick the subcommand, print the help. */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "cli/command.h"

static const char VERSION[] = "asbdpt 0.1";

static const struct {
    const char *name, *help;
    int (*run)(int argc, char **argv);
} COMMANDS[] = {
    {"render", "render a scene: asbdpt render SCENE.pbrt [-o FILE.{pfm,ppm,png}]... [options]", command_render},
    {"compare", "compare pictures: asbdpt compare IMAGE REFERENCE [--heatmap FILE.png] [--json]", command_compare},
    {"experiment", "measure methods: asbdpt experiment [--quick|--full] [SCENE...] -o DIR [options]", command_experiment},
    {"bench", "measure speed: asbdpt bench SCENE... [--json FILE] [--baseline FILE] [--spp N] [--maxdepth N] [-j N]",
     command_bench},
    {"verify", "test that methods agree: asbdpt verify SCENE [--methods A,B] [--batches N] [--tile N] [options]",
     command_verify},
    {"info", "describe a scene: asbdpt info SCENE.pbrt [options]", command_info},
};
enum { N_COMMANDS = sizeof COMMANDS / sizeof COMMANDS[0] };

static void print_methods(void)
{
    printf("\nintegrators and their parameters (-P NAME=VALUE, or in the scene's Integrator directive):\n");
    printf("    all: maxdepth 5, heuristic balance|power, rrthreshold 0.5 (0: no Russian roulette)\n");
    for (const struct method *const *m = method_list(); *m != NULL; m++) {
        printf("    %-8s %s\n", (*m)->name, (*m)->help);
        for (const struct parameter *p = (*m)->parameters; p->name != NULL; p++)
            printf("             %-12s %-10s %s\n", p->name, p->fallback, p->help);
    }
}

static void print_help(void)
{
    printf("%s: Alias Sampled Bidirectional Path Tracing, a reference implementation\n\nusage:\n", VERSION);
    for (int i = 0; i < N_COMMANDS; i++)
        printf("    %-8s %s\n", COMMANDS[i].name, COMMANDS[i].help);
    printf("\noptions of render and info:\n"
           "    -o FILE              output, linear .pfm or sRGB .ppm .png; may be repeated\n"
           "    --integrator NAME    instead of the scene's\n"
           "    -P NAME=VALUE        set a parameter of the integrator\n"
           "    --spp N              samples per pixel\n"
           "    --maxdepth N         longest path, 1 = direct light\n"
           "    --res WxH            resolution of the film\n"
           "    --filter NAME        pixel filter: box triangle gaussian mitchell sinc\n"
           "    --cropwindow X0 X1 Y0 Y1  render a part of the film, as fractions\n"
           "    --nthreads N, -j N   threads (default: all processors)\n"
           "    --seed N             another set of random numbers (default 0)\n"
           "    --strategies DIR     write every strategy (s,t) as pictures of its own, unweighted and weighted\n"
           "    --quiet              no progress, no warnings\n");
    printf("\noptions of experiment (scenes: the five of scenes/ unless named):\n"
           "    -o DIR               where results go; started again with the same, it goes on where it stopped\n"
           "    --quick, --full      48 pixels wide, 8 to 64 spp; or 320 wide, 32 to 512 spp and all parameter sweeps\n"
           "    --spp N, --seeds N, --maxdepth N, --nthreads N, --quiet   as above; --seeds: renders per method\n"
           "    --res WxH, --res W   size, or width alone with the scene's aspect ratio\n"
           "    --reference PATH     picture, or directory of NAME.pfm (default: ref/ beside the scene, else rendered)\n"
           "    --reference-spp N    samples of a reference rendered here\n");
    print_methods();
    printf("\nexit status: 0 success, 1 the job failed, 2 wrong usage\n");
}

static bool asks_for_help(const char *word) { return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0; }

int main(int argc, char **argv)
{
    if (argc < 2)
        return usage_error("which command?");
    if (asks_for_help(argv[1]) || strcmp(argv[1], "help") == 0 || (argc == 3 && asks_for_help(argv[2]))) {
        print_help();
        return EXIT_OK;
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("%s\n", VERSION);
        return EXIT_OK;
    }
    for (int i = 0; i < N_COMMANDS; i++)
        if (strcmp(argv[1], COMMANDS[i].name) == 0)
            return COMMANDS[i].run(argc - 1, argv + 1);
    return usage_error("unknown command %s", argv[1]);
}
