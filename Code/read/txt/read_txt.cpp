#include "read/txt/read_txt.h"

#include "base/for_each.h"
#include "base/text.h"
#include "desc/validate.h"
#include "read/read_context.h"
#include "read/txt/property_line.h"
#include "read/txt/read_blocks.h"
#include "read/txt/scanner.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace {

constexpr int kVersion = 1;

// Returns where the blocks begin.
std::size_t readFirstLine(const SourceFile& source) {
    Scanner in(source);
    const std::string_view text = source.text;
    if (text.empty()) in.failAt(0, "the file is empty; expected 'raytracer 1' as its first line");
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf"; // some editors on Windows
    if (text.starts_with(kByteOrderMark)) in.moveTo(kByteOrderMark.size());
    const std::size_t start = in.offset();
    if (!text.substr(start).starts_with("raytracer"))
        in.failAt(start, "expected 'raytracer 1' as the first line of a native scene file");
    const Token word = in.next(), version = in.next();
    const auto number = parseInteger(version.text);
    if (word.text != "raytracer" || !number || *number < 1)
        in.failAt(start, "expected 'raytracer 1' as the first line of a native scene file");
    if (*number > kVersion)
        in.failAt(version.offset, cat("the file has version ", *number,
                                      " of the format; this program reads version ", kVersion,
                                      ", a newer one is needed"));
    expectLineEnd(in, "raytracer 1", word);
    return in.offset();
}

// Parts as large as to be worth the start of a thread, of which each thread has some.
std::size_t partBytesFor(std::size_t textBytes, int threads) {
    constexpr std::size_t kLeast = std::size_t{1} << 18;
    constexpr std::size_t kPartsPerThread = 4;
    return std::max(kLeast, textBytes / (kPartsPerThread * static_cast<std::size_t>(threads)));
}

// What one thread read; nothing when there was a mistake.
std::optional<Blocks> readPart(const SourceFile& source, const TxtPart& part) {
    try {
        ErrorList errors(source);
        Blocks blocks{{}, References(source, true)};
        if (readBlocks(source, part, errors, blocks) == part.last && errors.count() == 0)
            return blocks;
    } catch (const Error&) {
        // readInOrder() says it.
    }
    return {};
}

bool isResolved(const SourceFile& source, Blocks& blocks, const NameTables& names) {
    ErrorList errors(source);
    try {
        blocks.references.resolve(blocks.desc, names, errors);
    } catch (const Error&) {
        return false;
    }
    return errors.count() == 0;
}

// Of settings and world there is one in the whole file.
template <class Block> bool takeSingle(Block& all, const Block& some) {
    if (some.loc.offset == SourceLoc::kUnknown) return true;
    const bool isFirst = all.loc.offset == SourceLoc::kUnknown;
    all = some;
    return isFirst;
}

using Parts = std::vector<std::optional<Blocks>>;
template <auto list> void join(SceneDesc& all, Parts& parts) {
    std::size_t count = 0;
    for (const auto& part : parts) count += (part->desc.*list).size();
    (all.*list).reserve(count);
    for (auto& part : parts) {
        auto some = std::move(part->desc.*list);
        for (auto& block : some) (all.*list).push_back(std::move(block));
    }
}
template <auto... lists> void joinLists(SceneDesc& all, Parts& parts, int threads) {
    constexpr void (*kJoins[])(SceneDesc&, Parts&) = {join<lists>...};
    forEachOn(threads, std::size(kJoins), [&](std::size_t i) { kJoins[i](all, parts); });
}

// The parts, one behind the other.
std::optional<SceneDesc> joined(const SourceFile& source, Parts parts, int threads) {
    if (std::any_of(parts.begin(), parts.end(), [](const auto& part) { return !part; })) return {};
    std::vector<const References*> references;
    for (const auto& part : parts) references.push_back(&part->references);
    const NameTables names = References::namesOf(references);
    std::vector<std::uint8_t> isGood(parts.size());
    forEachOn(threads, parts.size(),
              [&](std::size_t i) { isGood[i] = isResolved(source, *parts[i], names); });
    if (std::find(isGood.begin(), isGood.end(), 0) != isGood.end()) return {};

    SceneDesc all;
    for (const auto& part : parts)
        if (!takeSingle(all.settings, part->desc.settings) ||
            !takeSingle(all.world, part->desc.world))
            return {};
    joinLists<&SceneDesc::cameras, &SceneDesc::textures, &SceneDesc::materials, &SceneDesc::lights,
              &SceneDesc::meshes, &SceneDesc::objects>(all, parts, threads);
    forEachOn(threads, parts.size(), [&](std::size_t i) { parts[i].reset(); });
    return all;
}

// On several threads; nothing when the text has a mistake, or is too small to be worth it.
std::optional<SceneDesc> readTogether(const SourceFile& source, int threads,
                                      std::size_t partBytes) {
    std::size_t first = 0;
    try {
        first = readFirstLine(source);
    } catch (const Error&) {
        return {};
    }
    const std::vector<TxtPart> parts = partsOf(source.text, first, partBytes, threads);
    Parts read(parts.size());
    // A mesh that is a large part of the file has all threads for itself.
    std::vector<std::size_t> small;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i].threads == 1) small.push_back(i);
    forEachOn(threads, small.size(),
              [&](std::size_t i) { read[small[i]] = readPart(source, parts[small[i]]); });
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i].threads > 1) read[i] = readPart(source, parts[i]);
    return joined(source, std::move(read), threads);
}

SceneDesc readInOrder(const SourceFile& source) {
    ErrorList errors(source);
    Blocks blocks{{}, References(source, false)};
    try {
        TxtPart all;
        all.first = readFirstLine(source);
        all.last = source.text.size();
        readBlocks(source, all, errors, blocks);
        blocks.references.resolve(blocks.desc, blocks.references.known(), errors);
    } catch (const Error& error) {
        errors.addComplete(error.what());
    }
    errors.throwIfAny();
    return std::move(blocks.desc);
}

} // namespace

SceneDesc readTxt(const SourceFile& source, int threads, std::size_t partBytes) {
    checkTextSize(source);
    // Whoever reads in parts says only that there is a mistake: the first one of the file, with all
    // that is said with it, is found by reading in order.
    if (threads <= 0) threads = hardwareThreads();
    if (partBytes == 0) partBytes = partBytesFor(source.text.size(), threads);
    if (threads > 1 && source.text.size() > partBytes)
        if (auto together = readTogether(source, threads, partBytes)) return std::move(*together);
    return readInOrder(source);
}
