// What rays meet of one shape that all of them were asked about, as far as it lies in its box:
// RaySetup::enters() and the choice between hits, a register of rays at a time.
// Included by the file of each instruction set inside its namespace, behind ray_lanes.inl.

std::size_t nearerInBox(const BoxedShape& shape, const RaySpan& rays, Hit* found, Hit* best,
                        std::uint32_t* asFar) {
    std::size_t count = 0;
    alignas(64) float t[W], bestT[W];
    std::uint32_t order[W], ray[W];
    for (std::size_t first = 0; first < rays.size(); first += W) {
        const std::size_t some = std::min<std::size_t>(W, rays.size() - first);
        unsigned met = 0;
        for (std::size_t i = 0; i < W; ++i) {
            const std::size_t at = first + std::min(i, some - 1);
            order[i] = static_cast<std::uint32_t>(at);
            t[i] = found[at].t, bestT[i] = best[at].t;
            met |= unsigned{found[at].isHit() && i < some} << i;
        }
        if (met == 0) continue;
        const RayLanes lanes(loadRays(rays, order, some, ray), shape.extent);
        const Floats farthest = Floats::load(bestT);
        Floats entry;
        met &= lanes.entering(shape.box, depthCuts(Floats(1.0f) / (farthest * lanes.dz)), entry);
        const Floats nearest = max(entry / lanes.dz, Floats::load(t));
        nearest.store(t);
        for (unsigned rest = met & bits(nearest <= farthest); rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            Hit& hit = found[first + i];
            if (t[i] < bestT[i])
                best[first + i] = {t[i], hit.u, hit.v, hit.prim, shape.number};
            else
                hit.t = t[i], hit.shape = shape.number, asFar[count++] = order[i];
        }
    }
    return count;
}
