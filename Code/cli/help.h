// The texts that describe the command line, made from the tables of options.
#pragma once

#include "cli/command.h"

#include <string>

std::string helpText();                              // raytracer --help
std::string commandHelpText(const Command& command); // raytracer NAME --help
// The same for what has no row in the table of sub-commands.
std::string commandHelpText(std::string_view usage, std::string_view about,
                            std::span<const Flag> flags);
std::string featureListText(); // raytracer --list-features
