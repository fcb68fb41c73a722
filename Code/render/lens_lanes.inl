// The formulas of Camera::rayFrom() for a perspective camera at rest, in its order.
// Included by the file of each instruction set inside its namespace, after vectors3.inl and
// disk_lanes.inl.

namespace {

inline Doubles3 forAll(Vec3d v) { return {Doubles(v.x), Doubles(v.y), Doubles(v.z)}; }

inline void raysFrom(const Camera::RoundLens& lens, LensBlock& block, std::size_t first) {
    const Doubles3 right = forAll(lens.right), up = forAll(lens.up), forward = forAll(lens.forward),
                   eye = forAll(lens.eye);
    const Doubles px = Doubles::load(block.x + first), py = Doubles::load(block.y + first);
    const Doubles3 line = right * (Doubles(lens.topLeft.x) + px * Doubles(lens.step.x)) +
                          up * (Doubles(lens.topLeft.y) - py * Doubles(lens.step.y)) + forward;
    const Doubles3 sharp = eye + line * (Doubles(lens.focusDistance) / dot(line, forward));
    DiskRow place;
    Floats::load(block.u + first).store(place.u), Floats::load(block.v + first).store(place.v);
    placeOnDisk(&place, 1);
    const Doubles3 onLens = right * (Doubles(Floats::load(place.x)) / Doubles(lens.apertureRatio)) +
                            up * Doubles(Floats::load(place.y));
    const Doubles3 from = eye + onLens * Doubles(lens.apertureRadius);
    const Floats x = from.x.toFloats(), y = from.y.toFloats(), z = from.z.toFloats();
    const Doubles3 way = sharp - Doubles3{Doubles(x), Doubles(y), Doubles(z)};
    const Doubles3 dir = way / sqrt(dot(way, way));
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
