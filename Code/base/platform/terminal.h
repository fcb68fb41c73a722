// What stderr is connected to, and how large it is.
#pragma once

struct Terminal {
    bool present = false;        // a terminal that knows the control sequences of ECMA-48
    int columns = 80, rows = 24; // the usual ones where there is none or it does not tell
};
Terminal terminalOfStderr();
