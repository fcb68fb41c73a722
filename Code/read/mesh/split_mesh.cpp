#include "read/mesh/mesh_steps.h"

#include <algorithm>
#include <span>
#include <utility>

namespace {

using Index = std::uint32_t;
using Corners = MeshDesc::Corners;

// Numbers the things that a part uses in the order of their use. Starting the next part takes no
// time, so that a million parts take no longer than one.
class Numbering {
public:
    explicit Numbering(std::size_t count) : entries_(count) {}
    void startPart() {
        ++part_;
        count_ = 0;
    }
    // The new number of thing i, and whether it is new.
    std::pair<Index, bool> number(Index i) {
        Entry& entry = entries_[i];
        const bool isNew = entry.part != part_;
        if (isNew) entry = {part_, count_++};
        return {entry.number, isNew};
    }

private:
    struct Entry {
        Index part = 0, number = 0;
    };
    std::vector<Entry> entries_;
    Index part_ = 0, count_ = 0;
};

template <class T>
void takeUsed(const RawVector<T>& values, std::span<const Corners> corners, Numbering& numbering,
              RawVector<T>& partValues, RawVector<Corners>& partCorners) {
    numbering.startPart();
    partCorners.reserve(corners.size());
    for (const Corners& c : corners) {
        Corners& to = partCorners.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [number, isNew] = numbering.number(c[k]);
            if (isNew) partValues.push_back(values[c[k]]);
            to[k] = number;
        }
    }
    partValues.shrink_to_fit();
}

// The slots of a part in the order of their use; one slot needs no list per triangle.
void takeSlots(std::span<const Index> materials, Numbering& numbering, SeparatePart& part) {
    numbering.startPart();
    part.mesh.triangleMaterials.reserve(materials.size());
    for (const Index slot : materials) {
        const auto [number, isNew] = numbering.number(slot);
        if (isNew) part.slots.push_back(slot);
        part.mesh.triangleMaterials.push_back(number);
    }
    if (part.slots.size() == 1) part.mesh.triangleMaterials = {};
}

} // namespace

std::vector<SeparatePart> splitMesh(MeshFile file) {
    MeshDesc& whole = file.mesh;
    std::vector<SeparatePart> parts(std::max<std::size_t>(1, file.parts.size()));
    Numbering slots(file.materials.size());
    const auto setSlots = [&](SeparatePart& part, std::span<const Index> materials) {
        if (!materials.empty())
            takeSlots(materials, slots, part);
        else if (!file.materials.empty())
            part.slots = {0};
    };
    if (parts.size() == 1) {
        const RawVector<Index> materials = std::move(whole.triangleMaterials);
        whole.triangleMaterials = {};
        if (!file.parts.empty()) {
            whole.name = std::move(file.parts[0].name);
            whole.loc = file.parts[0].loc;
        }
        parts[0].mesh = std::move(whole);
        setSlots(parts[0], materials);
        return parts;
    }
    Numbering points(whole.points.size()), normals(whole.normals.size()), uvs(whole.uvs.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::size_t first = file.parts[i].firstTriangle,
                          last = i + 1 < parts.size() ? file.parts[i + 1].firstTriangle
                                                      : whole.triangles.size();
        const auto rangeOf = [&](const auto& array) {
            return array.empty() ? std::span(array) : std::span(array).subspan(first, last - first);
        };
        MeshDesc& mesh = parts[i].mesh;
        mesh.name = std::move(file.parts[i].name);
        mesh.loc = file.parts[i].loc;
        takeUsed(whole.points, rangeOf(whole.triangles), points, mesh.points, mesh.triangles);
        takeUsed(whole.normals, rangeOf(whole.normalTriangles), normals, mesh.normals,
                 mesh.normalTriangles);
        takeUsed(whole.uvs, rangeOf(whole.uvTriangles), uvs, mesh.uvs, mesh.uvTriangles);
        setSlots(parts[i], rangeOf(whole.triangleMaterials));
    }
    return parts;
}
