#include "light/tree/light_tree.h"

#include "base/math.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace {

constexpr std::size_t kBuckets = 12;
constexpr int kMostDepth = 32; // bits of a trail

std::uint32_t stepsOf(double x, float half) {
    return static_cast<std::uint32_t>(
        std::floor((clamp(x, -1.0, 1.0) + 1) * static_cast<double>(half)));
}

} // namespace

LightNode packedNode(const LightBounds& bounds, std::uint32_t child) {
    LightNode out{};
    double radius = 0;
    if (!bounds.isDistant) {
        const Vec3 centre = bounds.box.centre();
        out.centre[0] = centre.x, out.centre[1] = centre.y, out.centre[2] = centre.z;
        const Vec3d lo = toDouble(centre) - toDouble(bounds.box.lo);
        const Vec3d hi = toDouble(bounds.box.hi) - toDouble(centre);
        radius = length(Vec3d{max(lo.x, hi.x), max(lo.y, hi.y), max(lo.z, hi.z)});
    } else {
        out.centre[0] = static_cast<float>(clamp(bounds.reach2, 1e-30, 1e30));
    }
    out.intensity = static_cast<float>(min(bounds.intensity, 1e30)), out.child = child;
    const auto bits = std::bit_cast<std::uint32_t>(floatAbove(radius));
    const std::uint32_t up = radius > 0 ? (bits + 0xffffu) & 0xffff0000u : 0;
    const auto axis = [&](float x) {
        return stepsOf(static_cast<double>(x) + 0.5 / static_cast<double>(LightNode::kCosineSteps),
                       LightNode::kCosineSteps);
    };
    out.radiusAndX = up | axis(bounds.axis.x);
    out.yAndZ = axis(bounds.axis.y) << 16 | axis(bounds.axis.z);
    // The axis is off by 2^-15 at most.
    const std::uint32_t flags = (bounds.isTwoSided ? LightNode::kTwoSided : 0) |
                                (bounds.isDistant ? LightNode::kDistant : 0);
    out.spreadAndReach = stepsOf(bounds.cosSpread - 0x1p-14, LightNode::kCosineSteps) << 16 |
                         stepsOf(bounds.cosReach, LightNode::kReachSteps) << 2 | flags;
    return out;
}

// A light, or a sum of them, as far as the cost of a group needs it: the box, the mean of the axes.
struct LightPicker::Sum {
    Vec3 lo{kInfinityF, kInfinityF, kInfinityF}, hi{-kInfinityF, -kInfinityF, -kInfinityF};
    Vec3 axis; // times the intensity, and shorter the more its normals spread
    float intensity = 0, cosReach = 1;
    std::uint32_t count = 0;

    void add(const Sum& s) {
        lo = {min(s.lo.x, lo.x), min(s.lo.y, lo.y), min(s.lo.z, lo.z)};
        hi = {max(s.hi.x, hi.x), max(s.hi.y, hi.y), max(s.hi.z, hi.z)};
        axis = axis + s.axis;
        intensity += s.intensity, cosReach = min(cosReach, s.cosReach), count += s.count;
    }
    double cost() const {
        const Vec3d d = toDouble(hi) - toDouble(lo);
        // Normals that are even in a cap of cosine c have a mean of length (1 + c) / 2.
        const auto all = static_cast<double>(intensity);
        const double cosSpread = 2 * length(toDouble(axis)) / all - 1;
        return all * directionsOf(cosSpread, static_cast<double>(cosReach)) * dot(d, d);
    }
};

struct LightPicker::Item {
    Sum sum;
    float cosSpread;
    std::uint32_t light : 31, isTwoSided : 1;
    float middle(std::size_t axis) const { return sum.lo[axis] * 0.5f + sum.hi[axis] * 0.5f; }
};

class LightPicker::Builder {
public:
    Builder(LightPicker& out, std::span<const LightBounds> lights) : out_(out), lights_(lights) {}

    void build() {
        std::vector<std::uint32_t> distant;
        std::vector<Item> items;
        for (std::uint32_t i = 0; i < lights_.size(); ++i) {
            if (lights_[i].isDark()) continue;
            if (lights_[i].isDistant)
                distant.push_back(i);
            else
                items.push_back(itemOf(i));
        }
        out_.lit_ = static_cast<std::uint32_t>(items.size() + distant.size());
        out_.trails_.assign(lights_.size(), 0);
        if (out_.lit_ == 0) return;
        if (out_.lit_ == 1) return void(out_.only_ = items.empty() ? distant[0] : items[0].light);
        out_.pairs_.reserve(out_.lit_ - 1);
        if (distant.empty()) return void(splitLocal(items, 0, 0));
        if (items.empty()) return void(splitDistant(distant, 0, 0));
        // The root's own group: what is distant, and all else.
        out_.pairs_.emplace_back();
        const Made near = items.size() == 1 ? leaf(items[0].light, 0, 1) : splitLocal(items, 1, 0);
        Made far = distant.size() == 1 ? leaf(distant[0], 1, 1) : splitDistant(distant, 1, 1);
        const Vec3d size = toDouble(near.bounds.box.size());
        if (dot(size, size) > 0) far.bounds.reach2 = dot(size, size) / 4;
        put(0, 0, near), put(0, 1, far);
    }

private:
    struct Made {
        LightBounds bounds;
        std::uint32_t child;
    };

    Item itemOf(std::uint32_t i) const {
        const LightBounds& b = lights_[i];
        Item item;
        item.light = i & 0x7fffffffu, item.isTwoSided = b.isTwoSided ? 1 : 0;
        item.cosSpread = static_cast<float>(b.cosSpread);
        // Of the two ways that a light with two sides faces: the one that most of its kind have.
        const Vec3 a = b.axis;
        const float most = std::fabs(a.x) >= std::fabs(a.y) && std::fabs(a.x) >= std::fabs(a.z)
                               ? a.x
                           : std::fabs(a.y) >= std::fabs(a.z) ? a.y
                                                              : a.z;
        item.sum.lo = b.box.lo, item.sum.hi = b.box.hi;
        item.sum.intensity = static_cast<float>(min(b.intensity, 1e30));
        item.sum.axis = a * (item.sum.intensity * (0.5f + 0.5f * item.cosSpread) *
                             (b.isTwoSided && most < 0 ? -1.0f : 1.0f));
        item.sum.cosReach = static_cast<float>(b.cosReach), item.sum.count = 1;
        return item;
    }

    void put(std::size_t pair, std::size_t side, const Made& made) {
        out_.pairs_[pair].nodes[side] = packedNode(made.bounds, made.child);
    }
    Made leaf(std::uint32_t light, std::uint32_t trail, int depth) {
        out_.trails_[light] = trail, out_.depth_ = std::max(out_.depth_, depth);
        return {lights_[light], kLightLeaf + light};
    }

    // Around the sum of the axes; exact, as all of them are looked at again.
    static LightBounds boundsOfItems(std::span<const Item> items) {
        LightBounds out;
        Vec3d axis;
        double least = 1;
        bool isEverywhere = false;
        for (const Item& item : items) {
            out.box.extend(Bounds{item.sum.lo, item.sum.hi});
            const auto intensity = static_cast<double>(item.sum.intensity);
            axis += toDouble(item.sum.axis), out.intensity += intensity;
            least = min(least, static_cast<double>(item.sum.cosReach));
            out.isTwoSided |= item.isTwoSided != 0, isEverywhere |= item.cosSpread <= -1;
        }
        out.cosReach = least, out.cosSpread = -1;
        const double size = length(axis);
        if (isEverywhere || !(size > 0)) return out;
        axis = axis * (1 / size), out.axis = toFloat(axis);
        double cosine = 1; // of the largest angle
        for (const Item& item : items) {
            const Vec3d own = toDouble(item.sum.axis);
            double c = clamp(dot(own, axis) / length(own), -1.0, 1.0);
            if (item.cosSpread < 1) { // the light's own spread is added
                const double s = std::sqrt(1 - c * c), spread = static_cast<double>(item.cosSpread);
                const double sine = std::sqrt(max(1 - spread * spread, 0.0));
                // Beyond a half turn it goes everywhere.
                c = s * spread + c * sine < 0 ? -1 : c * spread - s * sine;
            }
            cosine = min(cosine, c);
        }
        out.cosSpread = cosine;
        return out;
    }

    // Makes the pair of the items, two or more, and all below it.
    Made splitLocal(std::span<Item> items, int depth, std::uint32_t trail) {
        const LightBounds bounds = boundsOfItems(items);
        const std::size_t first = splitAt(items, bounds, depth);
        const std::size_t pair = out_.pairs_.size();
        out_.pairs_.emplace_back();
        const auto side = [&](std::span<Item> part, std::uint32_t bit) {
            const std::uint32_t way = trail | bit << depth;
            return part.size() == 1 ? leaf(part[0].light, way, depth + 1)
                                    : splitLocal(part, depth + 1, way);
        };
        put(pair, 0, side(items.first(first), 0));
        put(pair, 1, side(items.subspan(first), 1));
        return {bounds, static_cast<std::uint32_t>(pair)};
    }

    // Divides them, and returns how many are in the first part.
    static std::size_t splitAt(std::span<Item> items, const LightBounds& bounds, int depth) {
        const std::size_t half = items.size() / 2;
        if (items.size() == 2) return 1;
        Bounds middles;
        for (const Item& item : items)
            middles.extend(Vec3{item.middle(0), item.middle(1), item.middle(2)});
        const Vec3 size = middles.size();
        const int longest = middles.longestAxis();
        const auto l = static_cast<std::size_t>(longest);
        if (!(size[l] > 0) ||
            depth + static_cast<int>(std::bit_width(items.size() - 1)) >= kMostDepth - 1)
            return byMiddle(items, l, half);

        float least = kInfinityF;
        std::size_t bestAxis = l, bestBucket = kBuckets;
        const std::size_t count = std::min(kBuckets, items.size()); // few items need few buckets
        std::array<Sum, kBuckets> buckets[3];
        Buckets by[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            by[axis] = {middles.lo[axis],
                        size[axis] > 0 ? static_cast<float>(count) / size[axis] : 0, count};
            std::fill_n(buckets[axis].begin(), count, Sum{});
        }
        for (const Item& item : items)
            for (std::size_t axis = 0; axis < 3; ++axis)
                buckets[axis][by[axis].of(item.middle(axis))].add(item.sum);
        const Vec3 whole = bounds.box.size();
        const float longestSide = max(max(whole.x, whole.y), whole.z);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!(size[axis] > 0)) continue;
            std::array<double, kBuckets> below{}, above{};
            std::array<bool, kBuckets> isBorder{};
            Sum sum;
            for (std::size_t i = 0; i + 1 < count; ++i) {
                // A border behind an empty bucket is the one before it.
                isBorder[i] = buckets[axis][i].count > 0;
                if (!isBorder[i]) continue;
                sum.add(buckets[axis][i]);
                if (sum.count == items.size()) isBorder[i] = false;
                if (isBorder[i]) below[i] = sum.cost();
            }
            sum = {};
            for (std::size_t i = count - 1; i > 0; --i) {
                if (buckets[axis][i].count > 0) sum.add(buckets[axis][i]);
                if (isBorder[i - 1]) above[i - 1] = sum.cost();
            }
            const float stretch = longestSide / whole[axis];
            for (std::size_t i = 0; i + 1 < count; ++i) {
                if (!isBorder[i]) continue;
                const auto cost =
                    static_cast<float>((below[i] + above[i]) * static_cast<double>(stretch));
                if (cost < least) least = cost, bestAxis = axis, bestBucket = i;
            }
        }
        if (bestBucket == kBuckets) return byMiddle(items, l, half);
        return divided(items, [&](const Item& item) {
            return by[bestAxis].of(item.middle(bestAxis)) <= bestBucket;
        });
    }
    struct Buckets {
        float lo = 0, perLength = 0;
        std::size_t count = 0;
        std::size_t of(float x) const {
            return std::min(static_cast<std::size_t>((x - lo) * perLength), count - 1);
        }
    };
    // As many in each part; the order of equal ones is that of their numbers.
    static std::size_t byMiddle(std::span<Item> items, std::size_t axis, std::size_t half) {
        std::sort(items.begin(), items.end(), [&](const Item& a, const Item& b) {
            const float x = a.middle(axis), y = b.middle(axis);
            return x < y || (x == y && a.light < b.light);
        });
        return half;
    }
    // std::partition may divide as it likes; this does in one way.
    template <class Fn> static std::size_t divided(std::span<Item> items, Fn&& isFirst) {
        std::size_t lo = 0, hi = items.size();
        for (;;) {
            while (lo < hi && isFirst(items[lo])) ++lo;
            while (lo < hi && !isFirst(items[hi - 1])) --hi;
            if (lo >= hi) return lo;
            std::swap(items[lo++], items[--hi]);
        }
    }

    // Suns are few: halves in their order.
    Made splitDistant(std::span<const std::uint32_t> suns, int depth, std::uint32_t trail) {
        LightBounds bounds;
        bounds.isDistant = true;
        Vec3d axis;
        for (const std::uint32_t i : suns) {
            axis += toDouble(lights_[i].axis) * lights_[i].intensity;
            bounds.intensity += lights_[i].intensity;
        }
        bounds.axis = length(axis) > 0 ? toFloat(axis * (1 / length(axis))) : bounds.axis;
        for (const std::uint32_t i : suns) {
            const double c = dot(toDouble(bounds.axis), toDouble(lights_[i].axis));
            const double own = lights_[i].cosSpread, s = std::sqrt(max(1 - c * c, 0.0));
            const double ownSine = std::sqrt(max(1 - own * own, 0.0));
            const double cosine =
                s * own + c * ownSine < 0 || own <= -1 ? -1 : c * own - s * ownSine;
            bounds.cosSpread = min(bounds.cosSpread, cosine);
        }
        const std::size_t pair = out_.pairs_.size(), half = suns.size() / 2;
        out_.pairs_.emplace_back();
        const auto side = [&](std::span<const std::uint32_t> part, std::uint32_t bit) {
            const std::uint32_t way = trail | bit << depth;
            return part.size() == 1 ? leaf(part[0], way, depth + 1)
                                    : splitDistant(part, depth + 1, way);
        };
        put(pair, 0, side(suns.first(half), 0));
        put(pair, 1, side(suns.subspan(half), 1));
        return {bounds, static_cast<std::uint32_t>(pair)};
    }

    LightPicker& out_;
    std::span<const LightBounds> lights_;
};

LightPicker::LightPicker(std::span<const LightBounds> lights) { Builder(*this, lights).build(); }
