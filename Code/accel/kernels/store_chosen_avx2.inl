// Lanes one after the other: see store_chosen_avx512.inl.
inline void storeChosenFloats(unsigned chosen, Floats a, float* to) {
    alignas(64) float all[W];
    a.store(all);
    for (; chosen != 0; chosen &= chosen - 1) *to++ = all[std::countr_zero(chosen)];
}
inline void storeChosenVectors(unsigned chosen, Floats x, Floats y, Floats z, float* to) {
    alignas(64) float all[3][W];
    x.store(all[0]), y.store(all[1]), z.store(all[2]);
    for (; chosen != 0; chosen &= chosen - 1)
        for (const auto& axis : all) *to++ = axis[std::countr_zero(chosen)];
}
inline unsigned spread(unsigned lowest, unsigned places) { return _pdep_u32(lowest, places); }
