#include "render/film_units.h"

#include "base/math.h"

#include <cmath>

FilmUnits filmUnitsOf(const Scene& scene, const RenderSettings& settings) {
    FilmUnits units;
    if (settings.picture.integrator == IntegratorKind::Whitted ||
        settings.picture.integrator == IntegratorKind::Path)
        units.color =
            std::ldexp(1.0, static_cast<int>(std::floor(settings.picture.exposureEv + 0.5)));
    if (settings.picture.integrator == IntegratorKind::Depth) units.color = scene.frame().scale;
    for (const Aov aov : settings.aovs)
        units.aovs.push_back(aov == Aov::Depth || aov == Aov::Position ? scene.frame().scale : 1);
    return units;
}
