// The blocks of a native scene file, or of a part of one, in the order of the text.
#pragma once

#include "base/source.h"
#include "desc/validate.h"
#include "desc/scene_desc.h"
#include "read/txt/references.h"
#include "read/txt/scanner.h"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

// Blocks begin in [first, last) of the text; none reaches over its `first`.
struct TxtPart {
    std::size_t first = 0, last = 0;
    int threads = 1; // for the arrays of large meshes
};
// Parts of about `partBytes` that begin behind lines with a '}', which end blocks in every file
// without a mistake. The first one begins at `first`; they do not depend on how many threads there
// are, only whose meshes get `threads` does: one that is a large part of the file.
std::vector<TxtPart> partsOf(std::string_view text, std::size_t first, std::size_t partBytes,
                             int threads);

struct Blocks {
    SceneDesc desc;
    References references; // to be resolved when the whole file is known
};

// The first mistake of form ends the reading with an Error; wrong values are collected. Returns
// where it ended: behind `last` when the last block goes on there.
std::size_t readBlocks(const SourceFile& source, const TxtPart& part, ErrorList& errors,
                       Blocks& blocks);

// The arrays of a mesh block: the one place of a scene file where megabytes of numbers stand.

// Reads from behind the '{' and its line end to behind the '}'. `open` is the word "mesh". Long
// arrays are read by so many threads.
void readMesh(Scanner& in, ErrorList& errors, const Token& open, MeshDesc& mesh, int threads = 1);

// The lines that place things: translate, rotate, scale, transform, look_at.

struct TransformLine {
    std::string_view keyword;
    std::size_t count;   // of numbers
    bool startsWithTurn; // the first one is an angle
    bool mayBeOne;       // one number stands for all
    // worldFromObject times what the line says; sets `fault` when the numbers say nothing.
    Rows (*apply)(const Rows& before, std::span<const double> numbers, std::string_view& fault);
};
std::span<const TransformLine> transformLines();
// Tells whether the view of look_at's nine numbers goes along its up direction, to 1e-10 radians:
// the roll of a camera would be decided by rounding.
bool isViewAlong(std::span<const double> numbers);
// Does one of their keywords, or "key", begin with this letter? Most lines say something else.
bool mayPlace(char first);

// One line `lobe KIND [VALUE numbers [times TEXTURE] [without TEXTURE [S]]]... [covers]` of a
// material.

// Behind the word `lobe`, up to the end of the line, of the block that `open` began. Fails at
// mistakes of form and unknown fields; an unknown kind, values that are wrong and a lobe too many
// are collected.
LobeDesc readLobeLine(Scanner& in, ErrorList& errors, References& references, const Token& open);
