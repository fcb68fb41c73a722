// The version that --version prints.
#pragma once

inline constexpr const char* kVersion = "0.1.0";
