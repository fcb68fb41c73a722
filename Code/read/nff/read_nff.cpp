#include "read/nff/read_nff.h"

#include "read/in_parts.h"
#include "read/in_turn.h"
#include "read/nff/scene.h"
#include "read/nff/split.h"
#include "read/text_size.h"

#include <optional>
#include <utility>
#include <vector>

namespace {

SceneDesc readInOrder(const SourceFile& source, const ReadContext& context) {
    ErrorList errors(source);
    SceneDesc desc;
    try {
        NffScene scene(source, context);
        scene.add(readNffEntities(source, {0, source.text.size(), {}}, context.options, errors),
                  {});
        desc = scene.finish(errors);
    } catch (const Error& error) {
        errors.addComplete(error.what());
    }
    errors.throwIfAny();
    return desc;
}

// With the fill that is in force at the start of each.
std::vector<NffRange> rangesOf(const SourceFile& source, std::size_t partBytes, int threads,
                               ErrorList& errors) {
    const std::string_view text = source.text;
    std::vector<std::size_t> starts = nffPartStarts(text, partBytes);
    const std::size_t count = starts.size();
    starts.push_back(text.size());
    std::vector<std::optional<std::size_t>> fills(count);
    if (count > 1)
        forEachOn(threads, count,
                  [&](std::size_t i) { fills[i] = lastNffFill(text, starts[i], starts[i + 1]); });
    std::vector<NffRange> ranges;
    NffFillHere fill;
    for (std::size_t i = 0; i < count; ++i) {
        ranges.push_back({starts[i], starts[i + 1], fill});
        if (fills[i]) fill = readNffFill(source, *fills[i], errors);
    }
    return ranges;
}

// On several threads; nothing when there is one, when the text has a mistake, or fills that do not
// begin their lines.
std::optional<SceneDesc> readInParts(const SourceFile& source, const ReadContext& context,
                                     std::size_t partBytes) {
    const int threads = context.options.threads;
    if (threads == 1) return {};
    ErrorList errors(source);
    const std::vector<NffRange> ranges = rangesOf(source, partBytes, threads, errors);
    if (ranges.size() == 1) return {};
    NffScene scene(source, context);
    const auto make = [&](std::size_t i) -> std::optional<NffEntities> {
        ErrorList unheard(source);
        auto part = readNffEntities(source, ranges[i], context.options, unheard);
        if (unheard.count() > 0) return {};
        return part;
    };
    bool isGood = true;
    auto range = ranges.begin();
    inTurn<std::optional<NffEntities>>(threads, ranges.size(), make, [&](auto part) {
        isGood = isGood && part && scene.add(std::move(*part), range->fill);
        ++range;
    });
    if (!isGood) return {};
    SceneDesc desc = scene.finish(errors);
    if (errors.count() > 0) return {};
    return desc;
}

} // namespace

SceneDesc readNff(const SourceFile& source, const ReadContext& context) {
    // Worth handing to a thread, and so small that what is made of a part finds room where that of
    // an earlier one was.
    constexpr std::size_t kPartBytes = std::size_t{1} << 16;
    return readNff(source, context, kPartBytes);
}

SceneDesc readNff(const SourceFile& source, const ReadContext& context, std::size_t partBytes) {
    checkTextSize(source);
    return readInPartsOrInOrder(source, context, partBytes, readInParts, readInOrder);
}
