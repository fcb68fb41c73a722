// The texts that describe the command line, made from the tables of options.
#pragma once

#include "cli/command.h"

#include <string>

std::string helpText();                              // raytracer --help
std::string commandHelpText(const Command& command); // raytracer NAME --help
std::string featureListText();                       // raytracer --list-features
