// One line `lobe KIND [VALUE numbers [times TEXTURE] [without TEXTURE [S]]]... [covers]` of a
// material.
#pragma once

#include "desc/error_list.h"
#include "desc/scene_desc.h"
#include "read/txt/references.h"
#include "read/txt/scanner.h"

// Behind the word `lobe`, up to the end of the line, of the block that `open` began. Fails at
// mistakes of form and unknown fields; an unknown kind, values that are wrong and a lobe too many
// are collected.
LobeDesc readLobeLine(Scanner& in, ErrorList& errors, References& references, const Token& open);
