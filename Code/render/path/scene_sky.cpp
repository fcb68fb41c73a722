#include "render/path/scene_sky.h"

#include "texture/sky_cells.h"

#include <cstddef>

namespace {

class SceneSky final : public SkyRadiance {
public:
    SceneSky(const Environment* environment, Rgb factor)
        : environment_(environment), factor_(factor) {}
    void radiance(std::size_t count, const float* const (&dir)[3],
                  float* const (&rgb)[3]) const override {
        for (std::size_t i = 0; i < count; ++i) {
            const Rgb c =
                environment_ == nullptr
                    ? factor_
                    : factor_ * environment_->radiance(Vec3{dir[0][i], dir[1][i], dir[2][i]});
            rgb[0][i] = c.r, rgb[1][i] = c.g, rgb[2][i] = c.b;
        }
    }

private:
    const Environment* environment_;
    Rgb factor_;
};

} // namespace

SkyTable skyTableOf(const Environment& environment, bool compensated, int threads) {
    const SkyCells cells = skyCells(environment, kMostSkyColumns, kMostSkyRows, threads);
    const Environment::View view = environment.view();
    return {cells.width,
            cells.height,
            cells.luminance,
            compensated,
            {view.up == Environment::Up::Z, view.turns},
            threads};
}

std::unique_ptr<const SkyRadiance> skyRadianceOf(const Environment* environment, Rgb factor) {
    return std::make_unique<const SceneSky>(environment, factor);
}
