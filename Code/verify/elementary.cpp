// T12: the elementary functions that reach pictures, which are our own so that they give the same
// bits everywhere, against binary128: at random arguments and where such functions go wrong.
#include "base/math.h"
#include "base/text.h"
#include "verify/elementary_truth.h"
#include "verify/groups.h"

#include <array>

namespace battery {

namespace {

using meshes::Random;

double signedLog(Random& random, double loExponent, double hiExponent) {
    const double size = std::ldexp(random.uniform(0.5, 1), // the fraction is even, too
                                   static_cast<int>(random.uniform(loExponent, hiExponent)));
    return random.chance(0.5) ? size : -size;
}
// A neighbour of x at most two doubles away.
double near(double x, Random& random) {
    for (std::uint32_t steps = random.below(3); steps > 0; --steps)
        x = random.chance(0.5) ? nextUp(x) : nextDown(x);
    return x;
}

struct Function {
    const char* name;
    double (*value)(double);
    Wide (*truth)(double);
    double (*argument)(Random&);
};

// Numerators of the convergents of pi: whole numbers that are nearly multiples of it.
constexpr std::array kNearPi = {
    3.0,          22.0,          355.0,           103993.0,        104348.0,         312689.0,
    1146408.0,    5419351.0,     80143857.0,      245850922.0,     411557987.0,      1068966896.0,
    6167950454.0, 21053343141.0, 1783366216531.0, 5371151992734.0, 139755218526789.0};

double anyAngle(Random& random) {
    switch (random.below(5)) {
    case 0: return random.uniform(-10, 10);
    case 1: return signedLog(random, -40, 47);
    case 2: return near(std::floor(random.uniform(-1e6, 1e6)) * kHalfPi, random);
    case 3: // the double next to a multiple of pi/4 of any size
        return near(std::floor(std::fabs(signedLog(random, 1, 46))) * (kHalfPi / 2), random);
    default: { // powers of two keep what is near a multiple near one
        const double x = kNearPi[random.below(kNearPi.size())];
        return near(x * std::ldexp(1.0, -static_cast<int>(random.below(3))), random);
    }
    }
}
double anySine(Random& random) {
    switch (random.below(4)) {
    case 0: return random.uniform(-1, 1);
    case 1: return signedLog(random, -60, 0);
    case 2: return (1 - std::fabs(signedLog(random, -53, 0))) * (random.chance(0.5) ? 1 : -1);
    default: return near(std::floor(random.uniform(-31, 32)) / 32, random);
    }
}
double anyExponent(Random& random) {
    switch (random.below(4)) {
    case 0: return random.uniform(-745, 709.7); // denormal results included
    case 1: return signedLog(random, -60, 3);
    case 2: // half-way between the steps of the table
        return near((std::floor(random.uniform(-23000, 22000)) + 0.5) * 0.021660849392498291,
                    random);
    default: return random.chance(0.5) ? random.uniform(709, 709.75) : random.uniform(-746, -708);
    }
}
double anyPower2(Random& random) {
    if (random.chance(0.3)) return near(std::floor(random.uniform(-34000, 32000)) / 32, random);
    return random.uniform(-1074, 1023.9);
}
double anyPositive(Random& random) {
    switch (random.below(4)) {
    case 0: return std::fabs(signedLog(random, -1073, 1024));
    case 1: return 1 + signedLog(random, -52, -1);
    case 2: // edges of the table's rows, at any size
        return near(
            std::ldexp(1 + random.below(257) / 256.0, static_cast<int>(random.below(9)) - 4),
            random);
    default:
        return near(std::ldexp(1.4142135623730951, static_cast<int>(random.below(3)) - 1), random);
    }
}
double anySize(Random& random) { return signedLog(random, -1073, 1024); }

constexpr std::array kAngles = {
    Function{"sin", exact::sin, truth::sin, anyAngle},
    Function{"cos", exact::cos, truth::cos, anyAngle},
    Function{"tan", exact::tan, truth::tan, anyAngle},
};
constexpr std::array kInverses = {
    Function{"asin", exact::asin, truth::asin, anySine},
    Function{"acos", exact::acos, truth::acos, anySine},
    Function{"atan", exact::atan, [](double x) { return truth::atan2(x, 1); },
             [](Random& random) {
                 return random.chance(0.5) ? signedLog(random, -60, 60)
                                           : near(random.below(65) / 32.0, random);
             }},
};
constexpr std::array kPowers = {
    Function{"exp", exact::exp, truth::exp, anyExponent},
    Function{"exp2", exact::exp2, truth::exp2, anyPower2},
    Function{"log", exact::log, truth::log, anyPositive},
    Function{"log2", exact::log2, truth::log2, anyPositive},
    Function{"cbrt", exact::cbrt, truth::cbrt, anySize},
};

void measure(const char* name, double x, double value, Wide truth, Tally& tally) {
    ++tally.cases;
    tally.measure(truth::ulpsOff(value, truth), [&] { return cat(name, " at ", shortest(x)); });
}
void measureAll(std::span<const Function> functions, Random& random, Tally& tally) {
    for (const Function& f : functions) {
        const double x = f.argument(random);
        measure(f.name, x, f.value(x), f.truth(x), tally);
    }
}

void measureAtan2(Random& random, Tally& tally) {
    const double range = random.chance(0.5) ? 3 : 500;
    const double y = signedLog(random, -range, range);
    // Half of the time near a step of the table, and near the diagonals.
    const double x = random.chance(0.5) ? signedLog(random, -range, range)
                                        : near(y * 16 / (1 + random.below(32)), random);
    ++tally.cases;
    tally.measure(truth::ulpsOff(exact::atan2(y, x), truth::atan2(y, x)),
                  [&] { return cat("atan2 at ", shortest(y), ", ", shortest(x)); });
}

void measurePow(Random& random, Tally& tally) {
    double x = std::fabs(signedLog(random, -1000, 1000)), y = 0;
    switch (random.below(3)) {
    case 0: y = random.uniform(-1074, 1024) / std::log2(x); break; // any result
    case 1:                                                        // a specular lobe
        y = std::fabs(signedLog(random, 0, 17));
        x = 1 - random.unit() / y;
        break;
    default: // a base at 1 and a huge exponent
        x = 1 + signedLog(random, -50, -10);
        y = random.uniform(-700, 700) / (x - 1);
    }
    if (!(std::fabs(y) < 0x1p64) || x == 1 || x <= 0) return;
    ++tally.cases;
    tally.measure(truth::ulpsOff(exact::pow(x, y), truth::pow(x, y)),
                  [&] { return cat("pow at ", shortest(x), ", ", shortest(y)); });
}

constexpr int kPerBatch = 1000;

Tally angles(const Effort& effort) {
    return inBatches(effort, 120, 15, [](Random& random, Tally& tally) {
        for (int i = 0; i < kPerBatch; ++i) measureAll(kAngles, random, tally);
    });
}
Tally inverses(const Effort& effort) {
    return inBatches(effort, 121, 10, [](Random& random, Tally& tally) {
        for (int i = 0; i < kPerBatch; ++i) {
            measureAll(kInverses, random, tally);
            measureAtan2(random, tally);
        }
    });
}
Tally powers(const Effort& effort) {
    return inBatches(effort, 122, 10, [](Random& random, Tally& tally) {
        for (int i = 0; i < kPerBatch; ++i) {
            measureAll(kPowers, random, tally);
            measurePow(random, tally);
        }
    });
}

constexpr Row kElementaryRows[] = {
    {"T12a", "our sin, cos, tan against binary128", "ulp", 2, true, angles},
    {"T12b", "our asin, acos, atan, atan2 against binary128", "ulp", 2, true, inverses},
    {"T12c", "our exp, exp2, log, log2, pow, cbrt against binary128", "ulp", 2, true, powers},
};

} // namespace

std::span<const Row> elementaryRows() { return kElementaryRows; }

} // namespace battery
