// OrenNayar: a rough diffuse surface, whose roughness is the sigma of Fujii's form of Oren and
// Nayar 1994, with the light of later bounces, so that a white one keeps all light (Portsmouth,
// Kutz and Hill 2024). Cycles 4 has it for the roughness of diffuse.
#pragma once

#include "material/lobe.h"

#include <limits>

LANES_BEGIN

struct OrenNayar {
    static constexpr const char* kName = "oren_nayar";
    static constexpr std::array<LobeField, 2> kFields{
        {{"color", 3, {1, 1, 1}, 0, 1}, {"roughness", 1, {0}, 0, 1}}};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights | kSpawnsRays | kDiffuse;

    explicit OrenNayar(const LobeNumbers& n) : color_(n.rgb(0)) {
        const Floats one(1.0f), sigma = min(max(n[3], Floats(0.0f)), one);
        flat_ = one / (one + sigma * Floats(kRise));
        slope_ = sigma * flat_;
        average_ = flat_ + slope_ * Floats(kMean);
        const Floats3 rest = rgbOf(one) - color_ * (one - average_);
        const Floats3 part = color_ * color_ * average_;
        again_ = {part.x / rest.x, part.y / rest.y, part.z / rest.z};
    }
    Floats3 below(const Floats3&) const { return rgbOf(0.0f); }
    Floats3 albedo(const Floats3& toEye) const {
        const Floats once = sentAlong(toEye.z);
        return color_ * once + again_ * max(Floats(1.0f) - once, Floats(0.0f));
    }
    Floats3 eval(const Floats3& toEye, const Floats3& toLight) const {
        const Floats zero(0.0f), one(1.0f), z = max(toLight.z, zero);
        // cos of the angle between the two, less the product of their cosines
        const Floats beside = toEye.x * toLight.x + toEye.y * toLight.y;
        const Floats larger = max(max(z, toEye.z), Floats(std::numeric_limits<float>::min()));
        const Floats retro = select(beside > zero, z / larger, z) * beside;
        const Floats once = max(flat_ * z + slope_ * retro, zero);
        const Floats eyeLoses = max(one - sentAlong(toEye.z), zero);
        const Floats lightLoses = max(one - sentAlong(z), zero);
        // At roughness 0 nothing is lost, on average either.
        const Floats lost = max(one - average_, Floats(1e-9f));
        const Floats later = z * eyeLoses * (lightLoses / lost);
        return (color_ * once + again_ * later) * Floats(static_cast<float>(kInvPi));
    }
    Floats pdf(const Floats3&, const Floats3& toLight) const {
        return max(toLight.z, Floats(0.0f)) * Floats(static_cast<float>(kInvPi));
    }
    LobeSample sample(const Floats3& toEye, Floats, Floats u, Floats v) const {
        const Floats3 toLight = cosineHemisphereFromSquare(u, v);
        const Floats density = pdf(toEye, toLight);
        const Floats least(std::numeric_limits<float>::min());
        const Floats3 weight = eval(toEye, toLight) / max(density, least);
        return {toLight, weight, density, maskOf(0)};
    }

private:
    // 1/2 - 2/(3 pi), and 2/3 - 28/(15 pi): what sigma adds to 1, and to the mean
    static constexpr float kRise = 0.28779342f, kMean = 0.07248821f;

    // What is sent on at once of the light along a direction with this cosine: Fujii's integral by
    // a polynomial of Portsmouth et al., right to 1e-3.
    Floats sentAlong(Floats z) const {
        const Floats m = Floats(1.0f) - min(z, Floats(1.0f));
        const Floats high = Floats(-0.332181442f) + m * Floats(0.0714429953f);
        const Floats g = m * (Floats(0.0571085289f) + m * (Floats(0.491881867f) + m * high));
        return min(flat_ + slope_ * g, Floats(1.0f));
    }

    Floats3 color_, again_;
    Floats flat_, slope_, average_;
};

LANES_END
