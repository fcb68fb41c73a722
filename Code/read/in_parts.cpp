#include "read/in_parts.h"

#include <iterator>
#include <utility>

namespace {

std::optional<SceneDesc> attempt(const SourceFile& source, const ReadContext& context,
                                 std::size_t partBytes, ReadInParts& readInParts) {
    Diagnostics said;
    std::optional<SceneDesc> scene;
    try {
        scene = readInParts(source, {context.options, said}, partBytes);
    } catch (const Error&) {
        return {};
    }
    if (scene)
        std::move(said.warnings.begin(), said.warnings.end(),
                  std::back_inserter(context.diagnostics.warnings));
    return scene;
}

} // namespace

SceneDesc readInPartsOrInOrder(const SourceFile& source, const ReadContext& context,
                               std::size_t partBytes, ReadInParts& readInParts,
                               ReadInOrder& readInOrder) {
    if (source.text.size() > partBytes)
        if (auto scene = attempt(source, context, partBytes, readInParts)) return std::move(*scene);
    return readInOrder(source, context);
}
