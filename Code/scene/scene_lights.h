// SceneLights: collects all that lights a scene: lamps, sky, and surfaces that shine.
#pragma once

#include "base/source.h"
#include "light/sky/sky_table.h"
#include "scene/path_lights.h"
#include "scene/scene.h"
#include "texture/environment.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class SceneLights {
public:
    SceneLights(const SceneDesc& desc, const SceneFrame& frame, const RenderSettings& settings);

    // Whether the sky lights surfaces as a lamp.
    bool skyLights() const { return isPath_ || desc_.world.environmentLights; }

    // Looks at the objects that are no meshes, which the description may let go of afterwards.
    void keepObjects();

    // What else is looked at, when all of it is there. `hasBody`, by light: a shape of the scene is
    // its body, whose object is that of the light.
    struct Surroundings {
        const ShapeSet& shapes;
        std::span<const SceneMaterial> materials;
        const Environment* environment; // null: none
        Rgb background;
        const std::vector<bool>& hasBody;
        std::uint32_t objects; // the first light's object
    };
    // Returns warnings, complete lines, of lamps without an area.
    std::vector<std::string> addTo(PathLights& lights, const Surroundings& around,
                                   const SourceFile& source) const;

private:
    struct ShiningObject {
        std::uint32_t object;
        bool back, bothSides; // the row is that of the back; it is that of the other side, too
        LightRow row;
    };
    std::vector<std::string> addLamps(PathLights& lights, const Surroundings& around,
                                      const SourceFile& source) const;
    // Returns false where samples of the object's light can't be taken.
    bool keepObject(std::uint32_t number, const MaterialDesc& material, Rgb radiance);
    void addSky(PathLights& lights, const Surroundings& around) const;
    void addTriangles(PathLights& lights, const Surroundings& around) const;
    PathLights::Entry surfaceEntry(const LightRow& row) const;

    const SceneDesc& desc_;
    const SceneFrame& frame_;
    const RenderSettings& settings_;
    bool isPath_;
    std::vector<ShiningObject> objects_;
    // Objects that are to light others, and don't: the first one, and how many there are.
    struct {
        std::string name;
        decltype(SourceLoc::offset) offset = 0;
        std::size_t count = 0;
    } unlit_;
};

// The sky of a scene as a lamp.

// Returns how a picture around the scene is sampled. `compensated`: see SkyTable.
SkyTable skyTableOf(const Environment& environment, bool compensated, int threads);
