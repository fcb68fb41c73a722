// How anything in the program fails: one exception, thrown by fail(), caught once in main().
// Knows nothing about files, scenes or terminals; printing is main()'s business.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

// The value is the exit code of the program (see --help).
enum class ErrorKind { Usage = 1, Input = 2, Output = 4 };

class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

private:
    ErrorKind kind_;
};

// The message is complete: "file:line:col: error: what; what would be right", no newline at its
// end.
[[noreturn]] inline void fail(ErrorKind kind, const std::string& message) {
    throw Error(kind, message);
}

// Warnings that a caller collects and main() prints; complete lines without a newline.
struct Diagnostics {
    std::vector<std::string> warnings;
    std::vector<std::string> filesRead; // the scene, its meshes and libraries, but no pictures
};
