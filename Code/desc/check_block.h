// BlockChecker: the rules for the blocks of a scene that need no other block of their kind, for a
// part of the blocks. What several parts find is put together in their order.
#pragma once

#include "base/source.h"
#include "desc/enum_tables.h"
#include "desc/validate.h"
#include "desc/names.h"
#include "desc/properties.h"
#include "desc/scene_desc.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// "sphere 'ball'", "settings"
std::string called(const AnyBlock& block);

inline std::size_t countOf(const SceneDesc& desc, BlockType target) {
    return target == BlockType::Texture    ? desc.textures.size()
           : target == BlockType::Material ? desc.materials.size()
                                        : desc.meshes.size();
}

// Which textures, materials and meshes something refers to; any thread may mark some.
class UsedBlocks {
public:
    explicit UsedBlocks(const SceneDesc& desc) {
        for (const BlockType type : kValuesOf<BlockType>)
            used_[static_cast<std::size_t>(type)].resize(countOf(desc, type));
    }
    void mark(BlockType target, std::size_t i) {
        const std::atomic_ref used(used_[static_cast<std::size_t>(target)][i]);
        if (used.load(std::memory_order_relaxed) == 0) used.store(1, std::memory_order_relaxed);
    }
    bool has(BlockType target, std::size_t i) const {
        return used_[static_cast<std::size_t>(target)][i] != 0;
    }

private:
    std::array<std::vector<std::uint8_t>, kNamesByValue<BlockType>.size()> used_;
};

// Per mesh: how many material slots its triangles use, as far as these may be; of those that are
// still to be read, 1.
std::vector<std::uint32_t> materialSlots(const SceneDesc& desc);

class BlockChecker {
public:
    // `slots`: materialSlots(). `threads`: what a large block may use.
    BlockChecker(const SceneDesc& desc, const SourceFile& source, UsedBlocks& used,
                 std::span<const std::uint32_t> slots, int threads = 1)
        : properties(source), wholes(source), desc_(desc), used_(used), slots_(slots),
          threads_(threads) {}

    // All rules of a block at once: those of large files come from the memory once.
    template <class Block> void check(const Block& block) {
        checkProperties(block);
        checkWhole(block);
    }

    // What another one found in the blocks behind these.
    void append(const BlockChecker& other) {
        properties.append(other.properties);
        wholes.append(other.wholes);
        warnings.insert(warnings.end(), other.warnings.begin(), other.warnings.end());
        largestOfMaps = std::max(other.largestOfMaps, largestOfMaps);
        reach = std::max(other.reach, reach);
    }

    // Messages: of single properties, and of blocks as wholes.
    ErrorList properties, wholes;
    std::vector<std::string> warnings;
    // Of what places things, and of things in spaces of their own.
    double largestOfMaps = 0, reach = 1;

private:
    void checkProperties(const AnyBlock& block);
    void checkNumbers(const AnyBlock& block, const Property& property);
    void checkHandle(const AnyBlock& block, Handle handle, BlockType target,
                     std::string_view keyword);
    void checkWhole(const SettingsDesc&) {}
    void checkWhole(const WorldDesc&) {}
    void checkWhole(const MaterialDesc& material);
    void checkLobe(const MaterialDesc& material, std::size_t number);
    void checkWhole(const CameraDesc& camera);
    void checkWhole(const TextureDesc& texture);
    void checkWhole(const LightDesc& light);
    void checkWhole(const MeshDesc& mesh);
    void checkWhole(const ObjectDesc& object);
    void checkInstance(const ObjectDesc& object);
    void warnOfUnused(const LightDesc& light);
    void checkCorners(const MeshDesc& mesh, std::span<const MeshDesc::Corners> corners,
                      std::size_t count, std::string_view values, std::string_view keyword);
    void checkKeys(const AnyBlock& block, std::span<const Rows> keys);

    template <class... Parts> void error(const AnyBlock& block, const Parts&... parts) {
        wholes.add(block.loc, [&] { return cat(called(block), ": ", parts...); });
    }

    const SceneDesc& desc_;
    UsedBlocks& used_;
    std::span<const std::uint32_t> slots_;
    int threads_;
};
