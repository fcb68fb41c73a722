#include "read/load.h"

#include "base/text.h"
#include "desc/check_block.h"
#include "desc/validate.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace {

// Tells of each block of a list whether it is refused, and warns of those that are.
template <class Block>
std::vector<bool> refused(const std::vector<Block>& blocks, const SceneDesc& desc,
                          const SourceFile& source, const ReadContext& context) {
    UsedBlocks used(desc);
    const std::vector<std::uint32_t> slots = materialSlots(desc);
    std::vector<bool> out(blocks.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        BlockChecker checker(desc, source, used, slots);
        checker.check(blocks[i]);
        for (const ErrorList* list : {&checker.properties, &checker.wholes})
            for (const std::string& message : list->messages())
                context.diagnostics.warnings.push_back(asWarning(message, "it is left out"));
        out[i] = checker.properties.count() + checker.wholes.count() > 0;
    }
    return out;
}

template <class Block> void erase(std::vector<Block>& blocks, const std::vector<bool>& wrong) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i)
        if (!wrong[i] && kept++ != i) blocks[kept - 1] = std::move(blocks[i]);
    blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(kept), blocks.end());
}

// Erases the meshes that are wrong and the objects that show them.
void eraseMeshes(SceneDesc& desc, const std::vector<bool>& wrong) {
    std::vector<Handle> handles;
    Handle next = 0;
    for (const bool isWrong : wrong) handles.push_back(isWrong ? kNone : next++);
    const auto showsWrong = [&](const ObjectDesc& o) {
        return o.mesh != kNone && wrong[static_cast<std::size_t>(o.mesh)];
    };
    std::erase_if(desc.objects, showsWrong);
    for (ObjectDesc& object : desc.objects)
        if (object.mesh != kNone) object.mesh = handles[static_cast<std::size_t>(object.mesh)];
    erase(desc.meshes, wrong);
}

} // namespace

std::string asWarning(std::string message, std::string_view consequence) {
    constexpr std::string_view kError = ": error: ";
    const std::size_t at = message.find(kError);
    if (at != std::string::npos) message.replace(at, kError.size(), ": warning: ");
    const std::size_t end = std::min(message.find('\n'), message.size()); // then comes the line
    return message.insert(end, cat("; ", consequence));
}

void leaveOutWrong(SceneDesc& desc, const SourceFile& source, const ReadContext& context) {
    const std::string fault = faultOfCrop(desc.settings);
    if (!fault.empty()) {
        context.warn(source, desc.settings.loc.offset, cat(fault, "; it is left out"));
        desc.settings.crop.reset();
    }
    erase(desc.lights, refused(desc.lights, desc, source, context));
    eraseMeshes(desc, refused(desc.meshes, desc, source, context));
    erase(desc.objects, refused(desc.objects, desc, source, context));
}
