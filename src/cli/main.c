/* main.c: asbdpt's command line begins here; command.c has everything that tests need too. */
#include "base/interrupt.h"
#include "base/os.h"
#include "cli/command.h"

int main(int argc, char **argv)
{
    os_open_standard();
    interrupt_init();
    return command_line(argc, argv);
}
