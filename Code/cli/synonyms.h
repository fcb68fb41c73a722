// What other renderers call an option of ours: for the message about an option that is not known.
#pragma once

#include <optional>
#include <string_view>

// Returns what to write here instead of another program's "--samples" or "-W", such as "--spp";
// nothing where no other program is known to use that name.
std::optional<std::string_view> ourWordsFor(std::string_view theirs);
