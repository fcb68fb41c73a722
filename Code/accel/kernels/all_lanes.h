// W lanes as they are, for formulas that are written for a few of them as well: picked from the
// registers, reckoned with and put back. See few_lanes_avx512.inl; who has no such lanes has none
// that are few.
#pragma once

#include "simd/lanes.h"

LANES_BEGIN

class AllLanes {
public:
    using Numbers = Doubles;
    static constexpr int kMost = 0; // lanes; 0: for any number

    explicit AllLanes(unsigned lanes) : lanes_(lanes) {}

    static Numbers pick(Floats a) { return Doubles(a); }
    static unsigned pick(unsigned lanes) { return lanes; }
    unsigned all() const { return lanes_; }

    static Floats rounded(const Numbers& a) { return a.toFloats(); }
    static Numbers exact(Floats a) { return Doubles(a); }
    static Floats putBack(Floats a) { return a; }
    static unsigned putBack(unsigned lanes) { return lanes; }

private:
    unsigned lanes_;
};

#if !defined(LANES_AVX512)
using FewLanes = AllLanes; // see few_lanes_avx512.h
#endif

LANES_END

#if defined(LANES_AVX512)
#include "accel/kernels/few_lanes_avx512.h"
#endif
