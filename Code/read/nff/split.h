// An NFF file in parts that threads can read at the same time.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

// Where parts of about `partBytes` begin: at lines whose first word names an entity, which begins
// one in every file without a mistake. The first is 0.
std::vector<std::size_t> nffPartStarts(std::string_view text, std::size_t partBytes);

// The last line between these starts that begins with the word 'f'. There may be another one behind
// it that does not stand at the start of its line.
std::optional<std::size_t> lastNffFill(std::string_view text, std::size_t first, std::size_t last);
