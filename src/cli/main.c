/* main.c: asbdpt's command line begins here; dispatch.c has everything that tests need too. */
#include "base/interrupt.h"
#include "base/os.h"
#include "cli/dispatch.h"

int main(int argc, char **argv)
{
    interrupt_init();
    os_limit_memory();
    return command_line(argc, argv);
}
