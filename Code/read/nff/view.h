// The view of an NFF file: 'v' and its lines, in any order.
#pragma once

#include "desc/validate.h"
#include "read/nff/terms.h"
#include "read/nff/words.h"

#include <optional>

bool isNffViewLine(const NffWord& word);

// Reads what follows the word 'v'. Nothing when it has errors, which are collected.
std::optional<NffView> readNffView(NffWords& in, ErrorList& errors, const NffWord& v);
