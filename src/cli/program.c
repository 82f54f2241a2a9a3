/* program.c: what asbdpt is made of. A new subcommand is a new word in COMMANDS. */
#include "cli/command.h"

static const struct command *const COMMANDS[] = {
    &command_render, &command_merge, &command_compare, &command_experiment, &command_bench, &command_verify,
    &command_info, &command_demo, &command_convert, &command_worth, &command_trace, NULL};

const struct program program = {
    "asbdpt", "Alias Sampled Bidirectional Path Tracing, a reference implementation",
    "Renders scenes of pbrt-v3 with path tracing, light tracing, bidirectional path tracing and its alias sampled kin, "
    "compares pictures and measures integrators.", COMMANDS};
