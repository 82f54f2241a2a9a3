/* program.c: what asbdpt is made of. A new subcommand is a new word in COMMANDS. */
#include "cli/command.h"

static const struct command *const COMMANDS[] = {&command_render, &command_merge, &command_convert, NULL};

const struct program program = {
    "asbdpt", "Alias Sampled Bidirectional Path Tracing, a reference implementation",
    "Renders scenes of pbrt-v3 by path tracing, light tracing, and bidirectional path tracing with and without alias "
    "sampling. Merges and converts images. asbdpt-lab describes, compares, explains and measures.", COMMANDS,
    &command_render, "; asbdpt-lab has more commands"};
