// The formulas of SunLight::sample().
// Included by soft_lamp_lanes.inl.

class SunInLanes {
public:
    SunInLanes(const SunEmission& sun, const LitBlock& block, std::size_t first)
        : oneMinusCos_(sun.oneMinusCos) {
        const auto all = [](Vec3 v) { return Three::all(v.x, v.y, v.z); };
        const Frame frame = frameAround(sun.toSun);
        frame_ = {all(frame.x), all(frame.y), all(frame.z)};
        const Rgb light = sun.ofSample();
        irradiance_ = Three::all(light.r, light.g, light.b);
        seen_ = ~bits(dot(Three::load(block.n, first), frame_.z) <
                      Floats(-(sun.sinHalfAngle + kHorizonSlack)));
    }

    unsigned seen() const { return seen_; }

    void place(DiskRow& row, unsigned& unsure) const {
        placeOnCone(row, Doubles(oneMinusCos_), unsure);
    }
    void placeSurely(DiskRow& row, unsigned lanes) const {
        alignas(64) double all[W];
        std::fill_n(all, W, oneMinusCos_);
        placeSurelyOnCone(row, all, lanes);
    }

    void findWay(LampRow& row) const {
        const Three way = frame_.toWorld(Floats::load(row.x), Floats::load(row.y),
                                         zOnCone(row, Doubles(oneMinusCos_)));
        row.toLight = way / sqrt(dot(way, way));
        row.distance = Floats(kInfinityF);
    }

    Three irradiance(const LampRow&) const { return irradiance_; }

private:
    double oneMinusCos_;
    Frames frame_;
    Three irradiance_;
    unsigned seen_;
};

inline SunInLanes lookAt(const SunEmission& sun, const LitBlock& block, std::size_t first) {
    return {sun, block, first};
}
