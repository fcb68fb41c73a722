// The surfaces of W hits on balls: still_surfaces.inl with numbers of which most are constants.
// Included by the file of each instruction set behind that.

namespace {

// The numbers of a ball for each lane; lanes behind the last hit repeat it.
class NumbersOfBalls {
public:
    // The zeros of the maps are left out: they would add +0 or -0 to a product, which changes
    // nothing but the sign of a zero. Points lose that sign where the offset is added, which is not
    // 0; what is mapped without an offset are differences and what is made of sums, whose zeros are
    // +0 and stay so under a map that does not mirror.
    static constexpr bool kScales = true;

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

} // namespace

void ballSurfaces(const BallsMet& met, SurfacePlaces out) {
    SurfacesInLanes found;
    for (std::size_t first = 0; first < met.which.size(); first += W) {
        const std::size_t count = std::min<std::size_t>(W, met.which.size() - first);
        const auto which = met.which.subspan(first, count);
        const RaysInLanes rays = raysOf(met.rays, met.hits, which);
        const NumbersOfBalls balls(met, which, found);
        describe<Kind::Sphere>(balls, rays, rays.dir, found);
        found.put(met.to.subspan(first, count), out);
    }
}
