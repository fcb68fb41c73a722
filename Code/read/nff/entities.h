// The entities of an NFF file, or of a part of one, as the blocks of a scene. What depends on what
// stands in front of the part is left to NffScene.
#pragma once

#include "desc/error_list.h"
#include "read/nff/terms.h"
#include "read/nff/words.h"
#include "read/read_context.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

// 'f' and where it stands.
struct NffFillHere {
    NffFill fill;
    SourceLoc loc; // unknown before the first one
    bool isGiven() const { return loc.offset != SourceLoc::kUnknown; }
};

// A range of the text that begins and ends in front of entities.
struct NffRange {
    std::size_t first = 0, last = 0;
    NffFillHere fill; // in force at its start
};

// Polygons, and patches with normals: those of one fill are a mesh.
inline constexpr std::size_t kNffMeshKinds = 2;

// Things that show nothing are left out; all of a kind make one warning.
struct NffLeftOut {
    std::size_t count = 0, first = 0;
    void add(const NffWord& word) {
        if (count++ == 0) first = word.offset;
    }
    void add(const NffLeftOut& others) {
        if (count == 0) first = others.first;
        count += others.count;
    }
};

// The numbers of what has names: "sphere12".
struct NffCounts {
    std::size_t spheres = 0, cones = 0;
    std::array<std::size_t, kNffMeshKinds> meshes{};
    // Gives the next name to an object; of meshes, which kind it is.
    void name(ObjectDesc& object, std::size_t meshKind = 0);
};

struct NffEntities {
    // Of a fill that something uses: materials and meshes are made of these.
    struct Surface : NffFillHere {
        std::array<Handle, kNffMeshKinds> meshes{kNone, kNone};
    };
    // The lights, the view, and objects, which have a surface as their material or none. Only those
    // of a part that begins the file have names.
    SceneDesc desc;
    NffCounts counts;
    std::vector<Surface> surfaces; // by their first uses
    Surface noSurface;             // of what stands in front of all fills
    std::vector<std::size_t> uncolouredLights;
    NffFillHere lastFill;
    std::size_t view = NffWords::kNotGiven, background = NffWords::kNotGiven;
    NffLeftOut flatPolygons, pointSpheres, flatCones, withoutFill;
};

// Errors that need not stop are collected, others thrown.
NffEntities readNffEntities(const SourceFile& source, const NffRange& range,
                            const ReadOptions& options, ErrorList& errors);
// The entity 'f' that begins there.
NffFillHere readNffFill(const SourceFile& source, std::size_t offset, ErrorList& errors);
