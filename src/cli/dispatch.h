/* dispatch.h: from the words of a command line to the subcommand that is meant, and help. */
#ifndef ASBDPT_DISPATCH_H
#define ASBDPT_DISPATCH_H

/* command_line: what the program does with its arguments, argv[0] being its own name. Returns the exit status. */
int command_line(int argc, char **argv);

#endif
