/* main.c: asbdpt's command line begins here; command.c has everything that tests need too. */
#include "cli/command.h"

int main(int argc, char **argv) { return command_line(argc, argv); }
