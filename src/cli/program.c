/* program.c: what asbdpt is made of. A new subcommand is a new word in COMMANDS. */
#include "cli/command.h"

static const struct command *const COMMANDS[] = {&command_render, &command_merge, &command_convert, NULL};

const struct program program = {
    "asbdpt", "Alias Sampled Bidirectional Path Tracing, a reference implementation",
    "Renders scenes of pbrt-v3 with path tracing, light tracing, bidirectional path tracing and its alias sampled kin; "
    "adds up and converts pictures. What describes, compares, explains and measures is asbdpt-lab.", COMMANDS,
    &command_render};
