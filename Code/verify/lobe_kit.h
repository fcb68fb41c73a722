// Lobes of the list by one lane: cases of each kind, integrals over directions, and samples.
#pragma once

#include "base/math.h"
#include "material/lobe_types.h"
#include "material/lobes.h"
#include "verify/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace lobe_kit {

namespace {

using kernels::one::Floats;
using kernels::one::Floats3;
using kernels::one::LobeNumbers;
using kernels::one::LobeSample;

struct Case {
    std::uint32_t kind;
    std::array<float, kLobeNumbers> numbers{};
    float eta = 1;
    float width = 1; // its alpha, or the like: how narrow it is at least

    const LobeType& type() const { return lobeTypes()[kind]; }
    bool has(std::uint32_t flags) const { return (type().flags & flags) == flags; }
    bool is(std::string_view name) const { return name == type().name; }
    float* number(std::string_view name) {
        std::size_t at = 0;
        for (const LobeField& field : type().fields) {
            if (name == field.name) return &numbers[at];
            at += static_cast<std::size_t>(field.count);
        }
        return nullptr;
    }
};

inline std::string shown(const Case& c) {
    std::ostringstream out;
    out << c.type().name;
    std::size_t at = 0;
    for (const LobeField& field : c.type().fields) {
        out << " " << field.name;
        for (int i = 0; i < field.count; ++i) out << " " << c.numbers[at++];
    }
    if (c.has(kHasSides)) out << " eta " << c.eta;
    return out.str();
}

// The numbers that scenes start from, but colours are white.
inline Case whiteCase(std::uint32_t kind) {
    Case c{kind};
    std::size_t at = 0;
    for (const LobeField& field : c.type().fields)
        for (int i = 0; i < field.count; ++i)
            c.numbers[at++] = field.count == 3 ? 1.0f : field.start[i];
    return c;
}
inline std::uint32_t kindOf(std::string_view name) {
    for (std::uint32_t kind = 0; kind < lobeTypes().size(); ++kind)
        if (name == lobeTypes()[kind].name) return kind;
    throw std::string("no lobe ") + std::string(name);
}

inline constexpr float kRoughs[] = {0.04f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.85f, 1.0f};
inline constexpr float kExponents[] = {0.0f,  1.0f,   3.0f,   8.0f, 20.0f,
                                       50.0f, 120.0f, 400.0f, 1e3f, 1e4f};
inline constexpr float kEtas[] = {1 / 1.5f, 1.5f, 1 / 1.33f, 2.4f};

// White cases of a kind: ten roughnesses or exponents, and for those with sides both sides.
inline std::vector<Case> casesOf(std::uint32_t kind, std::size_t etas = 2) {
    std::vector<Case> all;
    for (std::size_t i = 0; i < std::size(kRoughs); ++i)
        for (std::size_t e = 0; e < etas; ++e) {
            Case c = whiteCase(kind);
            if (float* rough = c.number("roughness"))
                *rough = kRoughs[i], c.width = c.is("sheen") ? 0.5f : kRoughs[i] * kRoughs[i];
            else if (float* exponent = c.number("exponent"))
                *exponent = kExponents[i], c.width = 1 / std::sqrt(kExponents[i] + 1);
            else if (i > 0)
                continue;
            if (c.has(kHasSides))
                c.eta = kEtas[e];
            else if (e > 0)
                continue;
            all.push_back(c);
        }
    return all;
}

// Any numbers that scenes may have, a roughness often 0.
inline Case anyCase(std::uint32_t kind, meshes::Random& random) {
    const auto uniform = [&](float lo, float hi) {
        return static_cast<float>(random.uniform(static_cast<double>(lo), static_cast<double>(hi)));
    };
    Case c{kind};
    std::size_t at = 0;
    for (const LobeField& field : c.type().fields)
        for (int i = 0; i < field.count; ++i)
            c.numbers[at++] = uniform(field.least, std::min(field.most, 100.0f));
    if (float* const roughness = c.number("roughness"))
        *roughness = random.chance(0.2) ? 0 : uniform(0.03f, 1);
    if (float* const ior = c.number("ior")) *ior = uniform(1, 3);
    c.eta = random.chance(0.5) ? uniform(1, 3) : 1 / uniform(1, 3);
    return c;
}

// fn(lobe), with a lobe of the case's type.
template <class Fn> void with(const Case& c, Fn&& fn) {
    kernels::one::forLobe(c.kind, [&]<class L>() {
        fn(L(LobeNumbers{c.numbers.data(), 1, Floats(c.eta)}));
    });
}

inline Floats3 direction(double z, double phi) {
    const double sine = std::sqrt(std::max((1 - z) * (1 + z), 0.0));
    return {static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
            static_cast<float>(z)};
}
inline double largest(const Floats3& c) { return std::max(std::max(c.x.v, c.y.v), c.z.v); }

// Where a rectangle of z and phi has to be looked at closely.
struct Peak {
    double z, phi, width;
};
// The directions into which a smooth surface would send light from an eye at phi = 0.
inline std::vector<Peak> peaksOf(const Case& c, double cosEye) {
    const double width = static_cast<double>(c.width);
    std::vector<Peak> peaks{{cosEye, kPi, width}, {cosEye, -kPi, width}};
    const double eta = static_cast<double>(c.eta), cos2 = 1 - eta * eta * (1 - cosEye * cosEye);
    if (c.has(kHasSides) && cos2 > 0)
        for (const double turn : {kPi, -kPi})
            peaks.push_back({-std::sqrt(cos2), turn, width * std::min(std::fabs(1 - eta), 1.0)});
    return peaks;
}

// The integral of f(z, phi) over a rectangle of z and phi, which are an area on the sphere, to some
// times `tolerance`. Parts where f is 0 are divided `border` times: the border of what is not may
// be in them.
template <class F> class Integral {
public:
    Integral(const F& f, double tolerance, const std::vector<Peak>& peaks, int border = 0)
        : f_(f), tolerance_(tolerance), peaks_(peaks), border_(border) {}

    double over(double z0, double z1, double phi0, double phi1, int depth = 0) const {
        return refined(z0, z1, phi0, phi1, gauss(z0, z1, phi0, phi1), depth);
    }

private:
    double gauss(double z0, double z1, double phi0, double phi1) const {
        constexpr double at[] = {0.0694318442029737, 0.330009478207572, 0.669990521792428,
                                 0.930568155797026};
        constexpr double weight[] = {0.173927422568727, 0.326072577431273, 0.326072577431273,
                                     0.173927422568727};
        double sum = 0;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                sum += weight[i] * weight[j] *
                       f_(z0 + (z1 - z0) * at[i], phi0 + (phi1 - phi0) * at[j]);
        return sum * (z1 - z0) * (phi1 - phi0);
    }
    // Is it much larger, along z or along phi, than a peak in it, or than its distance from one?
    struct Coarse {
        bool z = false, phi = false;
    };
    Coarse coarse(double z0, double z1, double phi0, double phi1) const {
        Coarse is;
        for (const Peak& p : peaks_) {
            // How far z and phi go within a width of the peak, which is flat near the horizon.
            const double sine = std::sqrt(std::max(1 - p.z * p.z, 0.0));
            const double dz = p.width * (sine + p.width);
            const double dphi =
                sine > 2 * p.width ? 2 * p.width * (std::fabs(p.z) + p.width) / sine : 2 * kPi;
            const double widths = std::max({1.0, (z0 - p.z) / dz, (p.z - z1) / dz,
                                            (phi0 - p.phi) / dphi, (p.phi - phi1) / dphi});
            is.z |= z1 - z0 > 4 * dz * widths, is.phi |= phi1 - phi0 > 4 * dphi * widths;
        }
        return is;
    }
    double refined(double z0, double z1, double phi0, double phi1, double whole, int depth) const {
        const double z = 0.5 * (z0 + z1), phi = 0.5 * (phi0 + phi1);
        const Coarse is = coarse(z0, z1, phi0, phi1);
        if (depth < 40 && is.z && !is.phi)
            return over(z0, z, phi0, phi1, depth + 1) + over(z, z1, phi0, phi1, depth + 1);
        if (depth < 40 && is.phi && !is.z)
            return over(z0, z1, phi0, phi, depth + 1) + over(z0, z1, phi, phi1, depth + 1);
        const double parts[] = {gauss(z0, z, phi0, phi), gauss(z0, z, phi, phi1),
                                gauss(z, z1, phi0, phi), gauss(z, z1, phi, phi1)};
        const double sum = parts[0] + parts[1] + parts[2] + parts[3];
        const bool isDone = std::fabs(sum - whole) <= tolerance_ && (sum != 0 || depth >= border_);
        if (depth >= 40 || (isDone && !is.z)) return sum;
        return refined(z0, z, phi0, phi, parts[0], depth + 1) +
               refined(z0, z, phi, phi1, parts[1], depth + 1) +
               refined(z, z1, phi0, phi, parts[2], depth + 1) +
               refined(z, z1, phi, phi1, parts[3], depth + 1);
    }

    const F& f_;
    double tolerance_;
    const std::vector<Peak>& peaks_;
    int border_;
};

// The integral over directions with z between the first and the last of these heights, of f that is
// the same on both sides of the eye's plane, phi = 0. Near the horizon narrow strips of light would
// be overlooked in high parts.
template <class F>
double overHeights(const F& f, double tolerance, const std::vector<Peak>& peaks,
                   std::initializer_list<double> heights, int border = 0) {
    const Integral integral(f, tolerance, peaks, border);
    constexpr int kTurns = 4;
    double sum = 0;
    for (const double* z = heights.begin(); z + 1 != heights.end(); ++z)
        for (int turn = 0; turn < kTurns; ++turn)
            sum += integral.over(z[0], z[1], turn * kPi / kTurns, (turn + 1) * kPi / kTurns);
    return 2 * sum;
}
// The integral of eval() over all directions, right to 1e-4: cells of Integral are at most some
// hundred, each off by less than its tolerance.
inline double quadrature(const Case& c, const Floats3& toEye, double cosEye) {
    double sum = 0;
    const auto peaks = peaksOf(c, cosEye);
    with(c, [&](const auto& lobe) {
        const auto f = [&](double z, double phi) {
            return largest(lobe.eval(toEye, direction(z, phi)));
        };
        sum = overHeights(f, 1e-5, peaks, {0, 0.01, 0.06, 0.3, 1});
        if (c.is("translucent")) sum = overHeights(f, 1e-5, peaks, {-1, -0.3, -0.06, -0.01, 0});
        if (!c.has(kHasSides)) return;
        // What is transmitted is in a cone about the way straight on, whose border would be
        // overlooked in part; phi is about that way there, 0 away from the surface.
        const double sine = std::sqrt(1 - cosEye * cosEye);
        const auto through = [&](double z, double phi) {
            const double s = std::sqrt(1 - z * z), out = s * std::cos(phi);
            const double up = sine * out - cosEye * z;
            return up < 0 ? largest(lobe.eval(toEye, {static_cast<float>(-sine * z - cosEye * out),
                                                      static_cast<float>(s * std::sin(phi)),
                                                      static_cast<float>(up)}))
                          : 0;
        };
        std::vector<Peak> bent;
        for (const Peak& p : peaks)
            if (p.z < 0) {
                const double away = sine * p.z + cosEye * std::sqrt(1 - p.z * p.z);
                bent.push_back({std::sqrt(1 - away * away), away > 0 ? 0 : kPi, p.width});
            }
        const double eta = static_cast<double>(c.eta), edge = std::min(eta, 1 / eta), in = 1 - edge;
        sum += overHeights(
            through, 1e-5, bent,
            {edge, edge + 0.1 * in, edge + 0.3 * in, edge + 0.6 * in, edge + 0.9 * in, 1}, 3);
    });
    return sum;
}

// Calls fn(lobe, a sample of it) for random numbers, if the lobe has samples.
template <class Fn>
void withSample(const Case& c, const Floats3& toEye, meshes::Random& random, Fn&& fn) {
    const auto unit = [&] { return Floats(static_cast<float>(random.below(1u << 24)) * 0x1p-24f); };
    const Floats pick = unit(), u = unit(), v = unit();
    with(c, [&](const auto& lobe) {
        if constexpr (requires { lobe.sample(toEye, pick, u, v); })
            fn(lobe, lobe.sample(toEye, pick, u, v));
    });
}

// The mean of the weights of samples, which is the same integral, and its deviation.
struct Mean {
    double mean = 0, sigma = 0;
};
inline Mean sampled(const Case& c, const Floats3& toEye, meshes::Random& random) {
    constexpr int kCount = 2000;
    double sum = 0, squares = 0;
    for (int i = 0; i < kCount; ++i)
        withSample(c, toEye, random, [&](const auto&, const LobeSample& s) {
            const double weight = s.pdf.v > 0 ? largest(s.weight) : 0;
            sum += weight, squares += weight * weight;
        });
    const double mean = sum / kCount, variance = std::max(squares / kCount - mean * mean, 0.0);
    // What happens once in some hundred samples may not happen in these at all.
    return {mean, std::sqrt(variance / kCount) + 3.0 / kCount};
}

} // namespace

} // namespace lobe_kit
