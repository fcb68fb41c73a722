// The exit codes of the program, as --help lists them. Scripts depend on the numbers.
#pragma once

#include <array>
#include <string_view>

enum class ExitCode {
    Ok = 0,
    Usage = 1,
    Input = 2,
    StrictWarnings = 3,
    Output = 4,
    AboveTolerance = 5,
    Internal = 70,     // EX_SOFTWARE of sysexits.h
    Interrupted = 130, // 128 + SIGINT, as shells count
};

struct ExitCodeText {
    ExitCode code;
    std::string_view meaning;
};
inline constexpr std::array kExitCodes{
    ExitCodeText{ExitCode::Ok, "done"},
    ExitCodeText{ExitCode::Usage, "wrong option or argument"},
    ExitCodeText{ExitCode::Input, "error in the scene, a texture or another file that is read"},
    ExitCodeText{ExitCode::StrictWarnings, "warnings under --strict; no picture is written"},
    ExitCodeText{ExitCode::Output, "cannot write"},
    ExitCodeText{ExitCode::AboveTolerance, "diff: the pictures differ by more than --tol"},
    ExitCodeText{ExitCode::Internal, "error in the program itself"},
    ExitCodeText{ExitCode::Interrupted,
                 "stopped by SIGINT, SIGTERM or SIGHUP; no picture is written"},
};
