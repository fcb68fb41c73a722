#include "render/waves/texture_points.h"

#include <algorithm>
#include <numeric>

namespace {

// More materials than this are rare in one wave, and looking for a group takes time.
constexpr std::size_t kMostGroups = 16;
// Of a group; below, look-ups one by one are faster than a register that is almost empty.
constexpr std::size_t kFewestPoints = 3;

// Most points come in whole blocks.
void takeCoordinates(std::span<const std::uint32_t> points, const PointColumns& at,
                     TextureBlock& block) {
    constexpr std::size_t kTogether = PointColumns::kPoints;
    for (std::size_t first = 0; first < points.size();) {
        const std::uint32_t point = points[first];
        if (point % kTogether == 0 && first + kTogether <= points.size() &&
            points[first + kTogether - 1] - point == kTogether - 1) { // they ascend
            const PointBlock& from = at.block(point / kTogether);
            std::copy_n(from.uv[0], kTogether, block.u + first);
            std::copy_n(from.uv[1], kTogether, block.v + first);
            first += kTogether;
            continue;
        }
        const Vec2 uv = at.uv(point);
        block.u[first] = uv.x, block.v[first] = uv.y;
        ++first;
    }
}

// take(point, the picture's colour there) for all points.
template <class TakeFn>
void lookUp(const ByteTexture& texture, TextureColorsFn colors,
            std::span<const std::uint32_t> points, const PointColumns& at, const TakeFn& take) {
    TextureBlock block;
    while (!points.empty()) {
        const auto here = points.first(std::min(points.size(), TextureBlock::kPoints));
        points = points.subspan(here.size());
        takeCoordinates(here, at, block);
        colors(texture, block, here.size());
        for (std::size_t i = 0; i < here.size(); ++i)
            take(here[i], Rgb{block.color[0][i], block.color[1][i], block.color[2][i]});
    }
}

// The same for any texture.
template <class TakeFn>
void lookUp(const Texture& texture, TextureColorsFn colors, std::span<const std::uint32_t> points,
            const PointColumns& at, const TakeFn& take) {
    if (const auto bytes = texture.bytes()) return lookUp(*bytes, colors, points, at, take);
    for (const std::uint32_t point : points) take(point, texture.color(at.uv(point)));
}

// The steps of materialAt(), each for all points.
void applyTo(const SceneMaterial& material, TextureColorsFn colors,
             std::span<const std::uint32_t> points, const PointColumns& at,
             std::span<Material> numbers) {
    for (const std::uint32_t point : points) numbers[point] = material.base;
    const auto multiply = [&](const Texture* texture, Rgb Material::*number) {
        if (texture == nullptr) return;
        lookUp(*texture, colors, points, at,
               [&](std::uint32_t point, Rgb color) { numbers[point].*number *= color; });
    };
    const MaterialPictures& pictures = *material.pictures;
    multiply(pictures.diffuse, &Material::diffuse);
    multiply(pictures.specular, &Material::specular);
    multiply(pictures.emission, &Material::emission);
    if (pictures.opacity != nullptr)
        lookUp(*pictures.opacity, colors, points, at, [&](std::uint32_t point, Rgb color) {
            numbers[point].opacity *= pictures.opacity->valueOf(color);
        });
}

} // namespace

void TexturedPoints::clear() {
    used_ = last_ = 0;
    others_.clear();
}

void TexturedPoints::add(const SceneMaterial& material, std::uint32_t first, std::uint32_t count) {
    const auto addTo = [&](std::vector<std::uint32_t>& points) {
        const std::size_t before = points.size();
        points.resize(before + count);
        std::iota(points.begin() + static_cast<std::ptrdiff_t>(before), points.end(), first);
    };
    const auto isOf = [&](std::size_t group) { return groups_[group].material == &material; };
    if (used_ == 0 || !isOf(last_)) {
        std::size_t group = 0;
        while (group < used_ && !isOf(group)) ++group;
        if (group == kMostGroups) return addTo(others_);
        if (group == used_) {
            if (used_ == groups_.size()) groups_.emplace_back();
            groups_[used_].material = &material;
            groups_[used_++].points.clear();
        }
        last_ = group;
    }
    addTo(groups_[last_].points);
}

void TexturedPoints::apply(TextureColorsFn colors, const PointColumns& at,
                           std::span<Material> numbers) const {
    const auto oneByOne = [&](std::span<const std::uint32_t> points) {
        for (const std::uint32_t point : points) numbers[point] = materialAt(at[point]);
    };
    for (const Group& group : std::span(groups_).first(used_))
        if (colors == nullptr || group.points.size() < kFewestPoints)
            oneByOne(group.points);
        else
            applyTo(*group.material, colors, group.points, at, numbers);
    oneByOne(others_);
}
