// What stderr is connected to, and how large it is.
#pragma once

struct Terminal {
    bool present = false;
    int columns = 80, rows = 24; // of the terminal; the usual ones when there is none
};
Terminal terminalOfStderr();
