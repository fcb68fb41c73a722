// Owen-scrambled Sobol pairs as bits, for numbers or for registers of them: the sampler includes it
// for itself, kernels for their lanes, each in a namespace of its own.
#pragma once

#include "simd/region.h"

LANES_BEGIN

template <class Bits> constexpr Bits reversed(Bits x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    // The order of the bytes, in the form that compilers know an instruction for.
    return (x >> 24) | ((x >> 8) & 0xff00u) | ((x << 8) & 0xff0000u) | (x << 24);
}

// Owen scrambling of a number whose bits are reversed: every bit is flipped by a hash of the bits
// below it. Constants of Vegdahl, "Building a Better LK Hash" (2021), after Laine and Karras.
template <class X, class Bits> constexpr X scrambledReversed(X x, Bits seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// The second dimension of Sobol, bits reversed. Its matrix is Pascal's triangle modulo 2, which is
// five steps of sums over supersets of the bit positions (Ahmed 2024).
template <class Bits> constexpr Bits pascalReversed(Bits index) {
    index ^= index >> 16;
    index ^= (index >> 8) & 0x00ff00ffu;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 1) & 0x55555555u;
    return index;
}

// Both dimensions of Sobol as bits, of an index shuffled by the seed a and scrambled by b and c.
// Shuffling the index is Owen scrambling of the index; the first dimension of Sobol is the reversed
// index, so the two reversals between them cancel.
template <class Bits> struct Pair { Bits x, y; };
template <class Bits> constexpr Pair<Bits> scrambledPair(Bits shuffled, Bits b, Bits c) {
    return {reversed(scrambledReversed(shuffled, b)),
            reversed(scrambledReversed(pascalReversed(shuffled), c))};
}
template <class Bits> constexpr Pair<Bits> sobolPair(Bits sample, Bits a, Bits b, Bits c) {
    return scrambledPair(reversed(scrambledReversed(reversed(sample), a)), b, c);
}

LANES_END
