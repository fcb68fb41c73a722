// Scripts that complete the command line in a shell, made from the tables of options.
#pragma once

#include <string>

// shell: "bash", "zsh" or "fish".
std::string completionScript(const std::string& shell);
