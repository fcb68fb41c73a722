// Sheen: fibres that stand on a cloth, which shine at the edge and back to the light: a linearly
// transformed cosine (Zeltner, Burley and Chiang 2022), by the rational fits to its tables that
// MaterialX and OpenPBR publish. Cycles 4 has the tables.
#pragma once

#include "material/boundary.h"
#include "simd/pow_lanes.h"

LANES_BEGIN

struct Sheen {
    static constexpr const char* kName = "sheen";
    static constexpr std::array<LobeField, 1> kFields{{{"roughness", 1, {0.5f}, 0, 1}}};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights | kSpawnsRays | kDiffuse;

    explicit Sheen(const LobeNumbers& n) : rough_(min(max(n[0], Floats(0.01f)), Floats(1.0f))) {}
    Floats3 below(const Floats3& toEye) const { return restOf(albedo(toEye)); }
    Floats3 albedo(const Floats3& toEye) const {
        const Floats x = min(toEye.z, Floats(1.0f)), y = rough_, one(1.0f);
        const auto c = [](float number) { return Floats(number); };
        const Floats wide =
            y * (c(0.0206607f) + c(1.58491f) * y) / (c(0.0379424f) + y * (c(1.32227f) + y));
        const Floats inner = c(-1.14885f) + y * (c(1.7932f) - c(0.95943f) * y * y);
        const Floats middle = y * (c(-0.193854f) + y * inner) / (c(0.046391f) + y);
        const Floats more = y * (c(0.000654023f) + (c(-0.0207818f) + c(0.119681f) * y) * y) /
                            (c(1.26264f) + y * (c(-1.92021f) + y));
        const Floats off = (x - middle) / wide, power = max(c(-0.5f) * off * off, c(-80.0f));
        const Floats bell = expOf(Doubles(power), Doubles(0.0)).toFloats();
        constexpr float kPerRoot2Pi = 0.398942280f;
        return rgbOf(min(max(bell * c(kPerRoot2Pi) / wide + more, Floats(0.0f)), one));
    }
    Floats3 eval(const Floats3& toEye, const Floats3& toLight) const {
        return albedo(toEye) * pdf(toEye, toLight);
    }
    Floats pdf(const Floats3& toEye, const Floats3& toLight) const {
        const Transform t(*this, toEye);
        const Floats along = t.x * toLight.x + t.y * toLight.y, zero(0.0f), z = toLight.z;
        const Floats across = t.x * toLight.y - t.y * toLight.x;
        const Floats a = t.scale * along + t.shear * z, b = t.scale * across;
        const Floats part = t.scale / max((a * a + b * b) + z * z, Floats(1e-30f));
        return max(z, zero) * Floats(static_cast<float>(kInvPi)) * part * part;
    }
    LobeSample sample(const Floats3& toEye, Floats, Floats u, Floats v) const {
        const Transform t(*this, toEye);
        const Floats3 w = cosineHemisphereFromSquare(u, v);
        const Floats along = w.x - t.shear * w.z, z = t.scale * w.z;
        const Floats3 toLight =
            normalize(Floats3{t.x * along - t.y * w.y, t.y * along + t.x * w.y, z});
        return {toLight, albedo(toEye), pdf(toEye, toLight), maskOf(0)};
    }

private:
    // A direction becomes one of a cosine lobe by (scale, scale, 1) and by `shear` times its z that
    // is added along (x, y), the way in which the eye leans.
    struct Transform {
        Floats scale, shear, x, y;
        Transform(const Sheen& of, const Floats3& toEye) {
            const auto c = [](float number) { return Floats(number); };
            const Floats one(1.0f), x1 = min(toEye.z, one), r = of.rough_;
            scale = (c(2.58126f) * x1 + c(0.813703f) * r) * r /
                    (one + c(0.310327f) * x1 * x1 + c(2.60994f) * x1 * r);
            shear =
                sqrt(one - x1) * (r - one) * r * r * r /
                (c(0.0000254053f) + c(1.71228f) * x1 - c(1.71506f) * x1 * r + c(1.34174f) * r * r);
            const Floats length2 = toEye.x * toEye.x + toEye.y * toEye.y, length = sqrt(length2);
            const Mask leans = length2 > c(1e-30f);
            x = select(leans, toEye.x / length, one);
            y = select(leans, toEye.y / length, c(0.0f));
        }
    };

    Floats rough_;
};

LANES_END
