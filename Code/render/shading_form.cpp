#include "render/shading_form.h"

#include "base/text.h"
#include "render/waves/steps.h"

std::string shadingForm(const IntegratorContext& context) {
    if (context.settings.integrator == IntegratorKind::Ao) return "ambient occlusion, one form";
    if (context.settings.integrator != IntegratorKind::Whitted) return "first hits, one form";
    constexpr std::pair<bool Steps::*, const char*> kNames[] = {
        {&Steps::softLamps, "soft lamps"},
        {&Steps::lampBodies, "lamp bodies"},
        {&Steps::bounces, "bounces"},
        {&Steps::textures, "textures"},
        {&Steps::seeThrough, "see-through surfaces"}};
    std::vector<std::string> done;
    for (const auto& [member, name] : kNames)
        if (context.steps.*member) done.emplace_back(name);
    return cat("waves: ", done.empty() ? "point lamps and opaque surfaces" : join(done));
}
