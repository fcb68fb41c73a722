// The formulas of Camera::rayFrom() for a perspective camera at rest, in its order.
// Included by the file of each instruction set inside its namespace, after disk_lanes.inl.

namespace {

struct DoubleVectors {
    Doubles x, y, z;
    static DoubleVectors all(Vec3d v) { return {Doubles(v.x), Doubles(v.y), Doubles(v.z)}; }
};
inline DoubleVectors operator+(const DoubleVectors& a, const DoubleVectors& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline DoubleVectors operator-(const DoubleVectors& a, const DoubleVectors& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline DoubleVectors operator*(const DoubleVectors& a, const Doubles& s) {
    return {a.x * s, a.y * s, a.z * s};
}
inline Doubles dot(const DoubleVectors& a, const DoubleVectors& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline void raysFrom(const Camera::RoundLens& lens, LensBlock& block, std::size_t first) {
    const DoubleVectors right = DoubleVectors::all(lens.right), up = DoubleVectors::all(lens.up),
                        forward = DoubleVectors::all(lens.forward),
                        eye = DoubleVectors::all(lens.eye);
    const Doubles px = Doubles::load(block.x + first), py = Doubles::load(block.y + first);
    const DoubleVectors line = right * (Doubles(lens.topLeft.x) + px * Doubles(lens.step.x)) +
                               up * (Doubles(lens.topLeft.y) - py * Doubles(lens.step.y)) + forward;
    const DoubleVectors sharp = eye + line * (Doubles(lens.focusDistance) / dot(line, forward));
    DiskRow place;
    Floats::load(block.u + first).store(place.u), Floats::load(block.v + first).store(place.v);
    placeOnDisk(&place, 1);
    const DoubleVectors onLens =
        right * (Doubles(Floats::load(place.x)) / Doubles(lens.apertureRatio)) +
        up * Doubles(Floats::load(place.y));
    const DoubleVectors from = eye + onLens * Doubles(lens.apertureRadius);
    const Floats x = from.x.toFloats(), y = from.y.toFloats(), z = from.z.toFloats();
    const DoubleVectors way = sharp - DoubleVectors{Doubles(x), Doubles(y), Doubles(z)};
    const Doubles length = sqrt(dot(way, way));
    const DoubleVectors dir{way.x / length, way.y / length, way.z / length};
    x.store(block.org[0] + first), y.store(block.org[1] + first), z.store(block.org[2] + first);
    dir.x.toFloats().store(block.dir[0] + first);
    dir.y.toFloats().store(block.dir[1] + first);
    dir.z.toFloats().store(block.dir[2] + first);
    // A division by what is positive would change no zero.
    const Floats clip = lens.clipStart == 0
                            ? Floats(0.0f)
                            : (Doubles(lens.clipStart) / dot(dir, forward)).toFloats();
    clip.store(block.tMin + first);
}

} // namespace

void sobolPairs(PairBlock& block) {
    for (std::size_t i = 0; i < PairBlock::kPairs; i += kSobolLanes) {
        const auto pair = sobolPair<Bits>(loadBits(block.sample + i), loadBits(block.index + i),
                                          loadBits(block.x + i), loadBits(block.y + i));
        storeUnit(pair.x, block.u + i), storeUnit(pair.y, block.v + i);
    }
}

void lensRays(const Camera::RoundLens& lens, LensBlock& block) {
    for (std::size_t first = 0; first < LensBlock::kRays; first += W) raysFrom(lens, block, first);
}
