/* program.c: what asbdpt-lab is made of. A new subcommand is a new word in COMMANDS. */
#include "lab/commands.h"

static const struct command *const COMMANDS[] = {&command_verify, &command_experiment, &command_equal_time,
                                                &command_demo,   &command_transient, &command_bench, NULL};

const struct program program = {
    "asbdpt-lab", "the laboratory of asbdpt: what measures its pictures and its speed",
    "Tests whether pictures have the same expectation, repeats the dissertation's measurements, gives methods the same "
    "time, and measures the speed of the renderer's parts.", COMMANDS, NULL};
