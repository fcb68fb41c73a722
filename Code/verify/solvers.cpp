// T14: the roots of quadratics against their roots in 113 bits. b^2 and 4ac of doubles are exact in
// those, so whether there are roots is known for certain. There are no cubics and quartics in the
// program.
#include "base/quadratic.h"
#include "base/text.h"
#include "verify/binary128.h"
#include "verify/groups.h"

namespace battery {

namespace {

struct Quadratic {
    double a = 0, b = 0, c = 0;
};

double whole(meshes::Random& random, std::size_t size) {
    return static_cast<double>(random.below(2 * size + 1)) - static_cast<double>(size);
}
double eitherSign(meshes::Random& random, double x) { return random.chance(0.5) ? x : -x; }

Quadratic fromRoots(double a, double p, double q) { return {a, -a * (p + q), a * (p * q)}; }

Quadratic someQuadratic(meshes::Random& random) {
    const auto any = [&] { return eitherSign(random, random.logUniform(1e-12, 1e12)); };
    switch (random.below(7)) {
    case 0: return {any(), any(), any()};
    case 1: { // two roots that share up to all of their digits
        const double a = any(), p = any(), apart = random.logUniform(1e-17, 0.1);
        return fromRoots(a, p, p * (1 + eitherSign(random, apart)));
    }
    case 2: { // neighbouring roots of Wilkinson's polynomial, a coefficient off by up to 2^-23
        const double p = 1 + random.below(20);
        const Quadratic exact = fromRoots(1, p, p + 1);
        const double off = random.logUniform(0x1p-52, 0x1p-23);
        return {1, exact.b * (1 + eitherSign(random, off)), exact.c};
    }
    case 3: { // whole numbers: a double root, or two close to each other, without any rounding
        const double a = whole(random, 1000), p = whole(random, 1000000);
        return fromRoots(a, p, p + whole(random, 2));
    }
    case 4: { // b^2 / 4ac from 1 to 1e24
        const double b = any(), ratio = random.logUniform(1e-24, 1);
        return {1, b, b * b / 4 * eitherSign(random, ratio)};
    }
    case 5: { // the discriminant is a few units of the last place of b^2
        const double half = whole(random, 1 << 26);
        return {half + whole(random, 2), 2 * half, half + whole(random, 2)};
    }
    default: { // without one of the terms
        Quadratic q{any(), any(), any()};
        const std::uint32_t without = random.below(3);
        (without == 0 ? q.a : without == 1 ? q.b : q.c) = 0;
        return q;
    }
    }
}

struct ExactRoots {
    int count = 0;
    Wide t[2] = {0, 0}; // ascending
};

ExactRoots exactRoots(const Quadratic& q) {
    const Wide a = q.a, b = q.b, c = q.c;
    if (a == 0) return b == 0 ? ExactRoots{} : ExactRoots{1, {-c / b, -c / b}};
    const Wide discriminant = b * b - 4 * a * c;
    if (discriminant < 0) return {};
    const Wide root = squareRoot(discriminant), sum = b < 0 ? b - root : b + root;
    if (sum == 0) return {1, {0, 0}};
    const Wide s = -sum / (2 * a), t = -2 * c / sum;
    if (discriminant == 0) return {1, {s, s}};
    return s < t ? ExactRoots{2, {s, t}} : ExactRoots{2, {t, s}};
}

double relativeError(double root, Wide exact) {
    if (exact == 0) return root == 0 ? 0 : kInfinity;
    return static_cast<double>(magnitude((root - exact) / exact));
}

void check(const Quadratic& q, Tally& tally) {
    const auto text = [&] {
        return cat(shortest(q.a), " t^2 + ", shortest(q.b), " t + ", shortest(q.c));
    };
    const Roots roots = solveQuadratic(q.a, q.b, q.c);
    const ExactRoots exact = exactRoots(q);
    ++tally.cases;
    // Two roots that are the same double count once.
    const bool areOne = exact.count == 2 && roots.count == 1 &&
                        magnitude(exact.t[1] - exact.t[0]) <= 8 * 0x1p-53 * magnitude(exact.t[0]);
    if (roots.count != exact.count && !areOne) return tally.fail(text);
    if (!(roots.t0 <= roots.t1)) return tally.fail(text); // NaN as well
    if (exact.count == 0) return;
    tally.measure(relativeError(roots.t0, exact.t[0]), text);
    tally.measure(relativeError(roots.t1, exact.t[1]), text);
}

// The coefficients are exact here, so the condition of the roots by their rounding is no excuse.
Tally quadratics(const Effort& effort) {
    return inBatches(effort, 14, 12, [](meshes::Random& random, Tally& tally) {
        for (int i = 0; i < 10000; ++i) check(someQuadratic(random), tally);
    });
}

constexpr Row kSolversRows[] = {
    {"T14", "roots of quadratics, clustered and of 1e-12 to 1e12", "relative", 1e-12, true,
     quadratics},
};

} // namespace

std::span<const Row> solverRows() { return kSolversRows; }

} // namespace battery
