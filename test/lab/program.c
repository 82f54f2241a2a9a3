/* program.c: what asbdpt-lab is made of: the renderer's commands, and those that look closer and measure. A new
 * subcommand is a new word in COMMANDS. */
#include "lab/commands.h"

static const struct command *const COMMANDS[] = {
    &command_render_more, &command_merge,      &command_convert, &command_sum,
    &command_info,        &command_compare,    &command_trace,
    &command_worth,      &command_strategies, &command_verify,  &command_conform,  &command_equal_time,
    &command_experiment, &command_family,     &command_transient, &command_bench,
    &command_corpus,     &command_progress, NULL};

const struct program program = {
    "asbdpt-lab", "the laboratory of asbdpt: what measures its pictures and its speed",
    "Does what asbdpt does, with more integrators. Compares pictures, tells how a sample came about, tests whether "
    "methods have the same expectation, gives them the same time, repeats the dissertation's measurements.", COMMANDS,
    &command_render_more, ""};
