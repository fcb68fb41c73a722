// NffScene: a scene from the parts of an NFF file, one behind the other: fills that several of them
// use become one material, the polygons of these one mesh, and everything gets its number.
#pragma once

#include "read/nff/entities.h"
#include "read/nff/surfaces.h"
#include "read/read_context.h"

#include <optional>

class NffScene {
public:
    NffScene(const SourceFile& source, const ReadContext& context);

    // False when the part can't stand behind those before: it was read with another fill than they
    // end with, or has again what stands once.
    bool add(NffEntities part, const NffFillHere& readWith);
    // Behind the last part. Warns.
    SceneDesc finish(ErrorList& errors);

private:
    bool takeSingles(NffEntities& part);
    void addLights(NffEntities& part);
    void addSurfaces(const NffEntities& part);
    void addObject(NffEntities& part, ObjectDesc& object);
    void addMesh(ObjectDesc& object, MeshDesc& mesh, NffEntities::Surface& surface,
                 std::size_t kind);
    ObjectDesc& addNamed(ObjectDesc& object, std::size_t meshKind);
    void warn(const NffLeftOut& leftOut, std::string_view one, std::string_view many) const;

    const SourceFile& source_;
    const ReadContext& context_;
    NffEntities all_;
    bool isEmpty_ = true;
    NffSurfaceTable surfaceOf_;           // of all_, from the second part on
    std::vector<std::uint32_t> surfaces_; // of the part that is added, in all_
};
