#include "render/shading_form.h"

#include "base/text.h"
#include "render/waves/steps.h"

#include <algorithm>

std::string shadingForm(const IntegratorContext& context) {
    if (context.settings.picture.integrator == IntegratorKind::Path) return "paths, one form";
    if (context.scene.isLobed()) return "lobes, one form";
    if (context.settings.picture.integrator == IntegratorKind::Ao)
        return "ambient occlusion, one form";
    if (context.settings.picture.integrator != IntegratorKind::Whitted)
        return "first hits, one form";
    constexpr std::pair<bool Steps::*, const char*> kNames[] = {
        {&Steps::softLamps, "soft lamps"},
        {&Steps::lampBodies, "lamp bodies"},
        {&Steps::bounces, "bounces"},
        {&Steps::textures, "textures"},
        {&Steps::seeThrough, "see-through surfaces"}};
    std::vector<std::string> done;
    for (const auto& [member, name] : kNames)
        if (context.steps.*member) done.emplace_back(name);
    const auto& lamps = context.shadingLamps;
    const auto maps = std::count_if(lamps.begin(), lamps.end(),
                                    [](const Lamp& lamp) { return lamp.map != nullptr; });
    if (maps > 0) done.push_back(cat("maps of ", maps, maps == 1 ? " lamp" : " lamps"));
    return cat("waves: ", done.empty() ? "point lamps and opaque surfaces" : join(done));
}
