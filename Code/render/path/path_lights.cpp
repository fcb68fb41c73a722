#include "render/path/path_lights.h"

#include "light/lights.h"

#include <algorithm>

namespace {

using namespace kernels::one;

Floats3 lanesOf(Vec3 v) { return {v.x, v.y, v.z}; }

std::uint64_t keyOf(std::uint32_t shape, std::uint32_t prim) {
    return std::uint64_t{shape} << 32 | prim;
}

} // namespace

std::uint32_t PathLights::add(const Entry& entry, float power) {
    entries_.push_back(entry);
    powers_.push_back(power);
    return static_cast<std::uint32_t>(entries_.size() - 1);
}

void PathLights::addUnshaped(std::uint32_t light, std::uint8_t seenBy) {
    unshaped_.push_back({light, seenBy});
}

void PathLights::addSurface(std::uint32_t shape, std::uint32_t prim, std::uint32_t light) {
    surfaces_[keyOf(shape, prim)] = light;
}

void PathLights::finish() {
    double total = 0, sum = 0;
    for (const float power : powers_) total += static_cast<double>(power);
    for (const float power : powers_) {
        sum += static_cast<double>(power);
        ends_.push_back(static_cast<float>(sum / total));
    }
}

PathLights::Pick PathLights::pick(float u) const {
    const auto it = std::upper_bound(ends_.begin(), ends_.end() - 1, u);
    const auto light = static_cast<std::uint32_t>(it - ends_.begin());
    return {light, *it - (light == 0 ? 0 : *(it - 1))};
}

float PathLights::pdf(Vec3 p, Vec3, std::uint32_t light, Vec3 dir) const {
    float pdf = 0;
    const LightRow& row = entries_[light].row;
    forLight(row.kind, [&]<class L> {
        pdf = L(LightNumbers{row.numbers.data(), 1}).pdf(lanesOf(p), lanesOf(dir)).v;
    });
    return pdf * (ends_[light] - (light == 0 ? 0 : ends_[light - 1]));
}

std::uint32_t PathLights::ofSurface(std::uint32_t shape, std::uint32_t prim) const {
    const auto it = surfaces_.find(keyOf(shape, prim));
    return it == surfaces_.end() ? kNone : it->second;
}

PathLights::Meeting PathLights::meetOne(std::uint32_t light, Vec3 org, Vec3 dir) const {
    Meeting out{kInfinityF, {}};
    const LightRow& row = entries_[light].row;
    forLight(row.kind, [&]<class L> {
        const LightMeeting at =
            L(LightNumbers{row.numbers.data(), 1}).meet(lanesOf(org), lanesOf(dir));
        out = {at.distance.v, {at.radiance.x.v, at.radiance.y.v, at.radiance.z.v}};
    });
    return out;
}
