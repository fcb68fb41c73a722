// Pictures that are integrals of known functions of two numbers, for what decides where samples go.
#pragma once

#include "film/noise_map.h"
#include "film/sample_plan.h"
#include "sample/dimensions.h"
#include "sample/sampler.h"

#include <functional>

namespace adaptive_kit {

// A picture, whose pixels are the means of value(x, y, u, v) over the square of u and v.
struct Integral {
    Tile area;
    std::function<double(int x, int y, Vec2 uv)> value;
    std::function<double(int x, int y)> truth; // the means
    std::uint32_t seed = 0;
    SamplerKind kind = SamplerKind::Sobol;
};

// The picture, rendered by the plan of a goal.
class Rendered {
public:
    Rendered(const Integral& integral, const Refinement& goal)
        : integral_(integral), isDisplay_(goal.unit == ErrorUnit::Display), measure(goal.unit, 1, SettingsDesc::Transfer::Srgb),
          noise(integral.area, measure), plan(goal),
          sampler_(integral.kind, Refinement::kFirstSamples, integral.seed) {
        film.reset(integral.area.width(), integral.area.height(), 1);
        while (true) {
            for (std::size_t b = 0; b < noise.blocks().size(); ++b) noise.update(b, film);
            const auto parts = plan.next(noise);
            if (parts.empty()) break;
            passes.push_back(parts);
            for (const SamplePlan::Part& part : parts) add(part);
        }
    }

    // Returns the RMSE, in the unit of the goal but for relative ones, over the pixels of an area: the values are grey.
    double trueError(const Tile& part) const {
        double sum = 0;
        for (int y = part.y0; y < part.y1; ++y)
            for (int x = part.x0; x < part.x1; ++x) {
                const double is = film.meanAt(x - integral_.area.x0, y - integral_.area.y0).x;
                const double right = integral_.truth(x, y);
                sum += sqr(shown(is) - shown(right));
            }
        return std::sqrt(sum / (part.width() * part.height()));
    }
    double shown(double value) const { return isDisplay_ ? 2 * measure.of(0, value) : value; }
    double trueError() const { return trueError(integral_.area); }
    double error() const { return plan.error(noise); }
    SamplePlan::Samples samples() const { return plan.samples(noise); }

private:
    void add(const SamplePlan::Part& part) {
        Film batch;
        batch.reset(part.tile.width(), part.tile.height(), 1);
        float largest = 0;
        for (int y = part.tile.y0; y < part.tile.y1; ++y)
            for (int x = part.tile.x0; x < part.tile.x1; ++x)
                for (int s = part.before; s < part.before + part.batch; ++s) {
                    const auto pixel = static_cast<std::uint32_t>(y * 4096 + x);
                    const Vec2 uv = sampler_.get2D(pixel, static_cast<std::uint32_t>(s), kLensDimension);
                    const auto value = static_cast<float>(integral_.value(x, y, uv));
                    batch.add(x - part.tile.x0, y - part.tile.y0, {value, value, value});
                    largest = std::max(largest, 3 * value);
                }
        noise.add(part.tile, part.batch, film, batch, largest);
        film.add(batch, part.tile.x0 - integral_.area.x0, part.tile.y0 - integral_.area.y0);
    }

    Integral integral_;
    bool isDisplay_;

public:
    ErrorMeasure measure;
    NoiseMap noise;
    SamplePlan plan;
    Film film;
    std::vector<std::vector<SamplePlan::Part>> passes;

private:
    Sampler sampler_;
};

} // namespace adaptive_kit
