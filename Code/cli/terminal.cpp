#include "cli/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

Terminal terminalOfStderr() {
    Terminal terminal;
    terminal.present = isatty(STDERR_FILENO) == 1;
    winsize size{};
    if (terminal.present && ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 &&
        size.ws_row > 0) {
        terminal.columns = size.ws_col;
        terminal.rows = size.ws_row;
    }
    return terminal;
}
