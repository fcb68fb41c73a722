#include "read/txt/references.h"

#include "base/text.h"
#include "desc/names.h"

#include <optional>
#include <utility>

namespace {

std::string unknownReference(const SceneDesc& desc, BlockType target, std::string_view name) {
    // The nearest name is looked for among so many and so short ones that it cannot take long.
    constexpr std::size_t kCandidates = 1000, kLength = 100;
    std::vector<std::string> known;
    const auto collect = [&](const auto& blocks) {
        for (const auto& block : blocks)
            if (known.size() < kCandidates && block.name.size() <= kLength)
                known.push_back(block.name);
    };
    if (target == BlockType::Texture)
        collect(desc.textures);
    else if (target == BlockType::Material)
        collect(desc.materials);
    else
        collect(desc.meshes);
    return cat("unknown ", nameOf(target), " ", unknownName(shown(name), known));
}

// The name, where it is written as it is; nothing when there are escapes.
std::optional<std::string_view> plainText(const Token& name) {
    if (name.kind == TokenKind::Word) return name.text;
    const std::string_view inside = name.text.substr(1, name.text.size() - 2);
    if (inside.find('\\') != std::string_view::npos) return {};
    return inside;
}

} // namespace

std::string_view References::keptText(const Token& name) {
    if (const auto plain = plainText(name)) return *plain;
    return quoted_.emplace_back(Scanner(*source_).nameIn(name));
}

Handle References::use(BlockType target, const Token& name) {
    const auto t = static_cast<std::size_t>(target);
    if (!isPart_)
        if (const auto plain = plainText(name))
            if (const auto found = known_[t].find(*plain))
                return static_cast<Handle>(*found);
    waiting_.push_back(name);
    return waitingAs(waiting_.size() - 1);
}

void References::resolve(SceneDesc& desc, const NameTables& names, ErrorList& errors) const {
    if (isComplete()) return;
    const Scanner in(*source_);
    const auto resolveOne = [&](Handle& handle, BlockType target, std::string_view) {
        if (handle >= kNone) return;
        const Token& t = waiting_[static_cast<std::size_t>(waitingAs(0) - handle)];
        const std::string quoted = t.kind == TokenKind::Word ? "" : in.nameIn(t);
        const std::string_view name = t.kind == TokenKind::Word ? t.text : quoted;
        const auto found = names[static_cast<std::size_t>(target)].find(name);
        handle = found ? static_cast<Handle>(*found) : kNone;
        if (!found)
            errors.add({static_cast<std::uint32_t>(t.offset)},
                       [&] { return unknownReference(desc, target, name); });
    };
    forEachBlock(desc, [&](auto& block) {
        forEachReference(block.kType, static_cast<void*>(&block), resolveOne);
    });
}

NameTables References::namesOf(std::span<const References* const> parts) {
    constexpr std::size_t kAhead = 16; // a table of many names lies in memory
    NameTables names;
    for (std::size_t target = 0; target < names.size(); ++target) {
        std::size_t count = 0;
        for (const References* part : parts) count += part->listed_[target].size();
        NameTable table(count);
        std::uint32_t number = 0;
        for (const References* part : parts) {
            const std::vector<Listed>& listed = part->listed_[target];
            for (std::size_t i = 0; i < listed.size(); ++i) {
                if (i + kAhead < listed.size()) table.prepare(listed[i + kAhead].hash);
                table.insert(listed[i].name, listed[i].hash, number++);
            }
        }
        names[target] = std::move(table);
    }
    return names;
}
