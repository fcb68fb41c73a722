#include "scene/path_lights.h"

#include "light/kinds/sky.h"
#include "light/lights.h"
#include "light/tree/pick_lanes.h"

#include <algorithm>
#include <utility>

namespace {

using namespace kernels::one;

Floats3 lanesOf(Vec3 v) { return {v.x, v.y, v.z}; }

void putAt(std::vector<std::uint32_t>& list, std::size_t at, std::uint32_t light) {
    if (list.size() <= at) list.resize(std::max(2 * list.size(), at + 1), PathLights::kNone);
    list[at] = light;
}

} // namespace

std::uint32_t PathLights::add(const Entry& entry) {
    entries_.push_back(entry);
    return static_cast<std::uint32_t>(entries_.size() - 1);
}

void PathLights::addUnshaped(std::uint32_t light, std::uint8_t seenBy) {
    unshaped_.push_back({light, seenBy});
    unshapedSeenBy_ |= seenBy;
}

void PathLights::addObject(std::uint32_t object, bool front, std::uint32_t light) {
    putAt(ofObject_, 2 * std::size_t{object} + front, light);
}

void PathLights::addTriangle(std::uint32_t shape, std::uint32_t triangle, std::uint32_t light) {
    if (ofTriangle_.size() <= shape) ofTriangle_.resize(shape + 1);
    putAt(ofTriangle_[shape], triangle, light);
}

void PathLights::addSky(SkyTable table, SkyRadiance radiance, double brightness, bool isOpen) {
    skyBrightness_ = brightness;
    skyTable_ = std::move(table), skyRadiance_ = radiance;
    sky_ = add({.row = {kSkyKind, {}}, .isOpen = isOpen, .isSoft = true});
}

void PathLights::makeTree() {
    std::vector<LightBounds> bounds;
    bounds.reserve(entries_.size());
    for (const Entry& entry : entries_)
        bounds.push_back(entry.row.kind == kSkyKind
                             ? boundsOfSky(kPi * skyTable_.mean() * skyBrightness_)
                             : boundsOf(entry.row));
    picker_ = LightPicker(bounds);
}

float PathLights::pdfOfLight(Vec3 p, std::uint32_t light, Vec3 dir) const {
    if (entries_[light].isOfSamplesAlone()) return kInfinityF;
    if (light == sky_) return SkyEmitter(skyView()).pdf(lanesOf(p), lanesOf(dir)).v;
    float pdf = 0;
    const LightRow& row = entries_[light].row;
    forLight(row.kind, [&]<class L> {
        pdf = L(LightNumbers{row.numbers.data(), 1}).pdf(lanesOf(p), lanesOf(dir)).v;
    });
    return pdf;
}

float PathLights::pdf(Vec3 p, Vec3 n, std::uint32_t light, Vec3 dir) const {
    const float pdf = pdfOfLight(p, light, dir);
    if (!(pdf > 0 && pdf < kInfinityF)) return pdf;
    return pdf * LightChoice(tree()).probability(lanesOf(p), lanesOf(n), Ints(light)).v;
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
