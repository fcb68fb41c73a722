// The texts that describe the command line, made from the tables of options.
#pragma once

#include "cli/flag.h"

#include <span>
#include <string>

std::string helpText();        // raytracer --help
std::string diffHelpText();    // raytracer diff --help
std::string benchHelpText();   // raytracer bench --help
std::string verifyHelpText();  // raytracer verify --help
std::string featureListText(); // raytracer --list-features
