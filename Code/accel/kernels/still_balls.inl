// The surfaces of W hits on balls: still_surfaces.inl with numbers of which most are constants.
// Included by the file of each instruction set behind that.

namespace {

// The numbers of a ball for each lane; lanes behind the last hit repeat it. The zeros of their maps
// may be left out where no coordinate is -0: they add +0 or -0 to a product, which changes nothing
// but -0, and sums of others never are that.
template <bool kWithoutZeros> class NumbersOfBalls {
public:
    static constexpr bool kScales = kWithoutZeros;

    // Writes whose surfaces they are.
    NumbersOfBalls(const BallsMet& met, std::span<const std::uint32_t> which, SurfacesInLanes& out)
        : scale_(met.balls.shared().scale), back_(met.balls.shared().back),
          errorPerPlace_(met.balls.shared().errorPerPlace) {
        for (std::size_t i = 0; i < W; ++i) {
            const std::uint32_t ray = which[i < which.size() ? i : which.size() - 1];
            const StillBalls::Ball& ball = met.balls[met.hits[ray].shape];
            const auto& [x, y, z] = ball.centre;
            centre_[0][i] = x, centre_[1][i] = y, centre_[2][i] = z;
            radius_[i] = ball.radius, leastError_[i] = ball.leastError;
            out.material[i] = ball.material, out.object[i] = ball.object;
        }
    }
    [[gnu::always_inline]] Doubles operator()(std::size_t number) const {
        switch (number) {
        case WorldFromObject:
        case WorldFromObject + 5:
        case WorldFromObject + 10: return scale_;
        case WorldFromObject + 3: return Doubles::load(centre_[0]);
        case WorldFromObject + 7: return Doubles::load(centre_[1]);
        case WorldFromObject + 11: return Doubles::load(centre_[2]);
        case ObjectFromWorld:
        case ObjectFromWorld + 5:
        case ObjectFromWorld + 10: return back_;
        case ObjectFromWorld + 3: return backTo(0);
        case ObjectFromWorld + 7: return backTo(1);
        case ObjectFromWorld + 11: return backTo(2);
        case Radius: return Doubles::load(radius_);
        case LeastError: return Doubles::load(leastError_);
        case ErrorPerPlace: return errorPerPlace_;
        default: return Doubles(0.0);
        }
    }

private:
    [[gnu::always_inline]] Doubles backTo(std::size_t axis) const {
        return Doubles(-0.0) - back_ * Doubles::load(centre_[axis]);
    }
    Doubles scale_, back_, errorPerPlace_;
    alignas(64) double centre_[3][W], radius_[W], leastError_[W];
};

inline bool mayLeaveOutZeros(const RaysInLanes& rays, const StillBalls::Shared& maps) {
    const Doubles zero(0.0);
    const auto least = [](const Doubles3& v) { return min(min(abs(v.x), abs(v.y)), abs(v.z)); };
    const auto isNegative = [&](const Doubles& x) {
        return atMost(abs(x), zero) & less(withSign(Doubles(1.0), x), zero);
    };
    if (!(maps.scale > 0 && maps.back > 0)) return false;
    if (atMost(min(least(rays.org), least(rays.dir)), zero) == 0) return true;
    unsigned negative = 0;
    for (const Doubles3& v : {rays.org, rays.dir})
        negative |= isNegative(v.x) | isNegative(v.y) | isNegative(v.z);
    return negative == 0;
}

} // namespace

void ballSurfaces(const BallsMet& met, SurfacePlaces out) {
    SurfacesInLanes found;
    for (std::size_t first = 0; first < met.which.size(); first += W) {
        const std::size_t count = std::min<std::size_t>(W, met.which.size() - first);
        const auto which = met.which.subspan(first, count);
        const RaysInLanes rays = raysOf(met.rays, met.hits, which);
        if (mayLeaveOutZeros(rays, met.balls.shared()))
            describe<Kind::Sphere>(NumbersOfBalls<true>(met, which, found), rays, rays.dir, found);
        else
            describe<Kind::Sphere>(NumbersOfBalls<false>(met, which, found), rays, rays.dir, found);
        found.put(met.to.subspan(first, count), out);
    }
}
