// Lights and the choice among them, in lanes: bit for bit what one lane gives.
#include "base/cpu.h"
#include "check.h"
#include "light/tree/light_tree.h"
#include "sample/hash.h"
#include "unit/light_answers.h"
#include "verify/light_kit.h"

#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace test_light_lanes {

using namespace light_kit;
using namespace light_questions;
using meshes::Random;

namespace {

struct Form {
    const char* name;
    bool (*isThere)();
    void (*answer)(const Questions&, Answers&);
};
#if defined(__x86_64__)
constexpr Form kForms[] = {
    {"sse", hasSse, sse}, {"avx2", hasAvx2, avx2}, {"avx512", hasAvx512, avx512}};
#else
constexpr std::span<const Form> kForms;
#endif

LightRow anyLight(Random& random, std::uint32_t kind) {
    const Vec3 centre = toFloat(random.inBox(1));
    const auto size = static_cast<float>(random.logUniform(1e-3, 3));
    const double spread = random.chance(0.5) ? kHalfPi : random.uniform(0.2, 1.5);
    const std::string name = lightKinds()[kind].name;
    if (name == "point") {
        PointRow row = point(centre, random.chance(0.3) ? 0 : size);
        if (random.chance(0.3)) row.attenuation = {0.5f, 0.25f, 1};
        return lightRow(row);
    }
    if (name == "spot") return lightRow(spot(random, centre, random.chance(0.3) ? 0 : size));
    if (name == "sun") return lightRow(sun(random, random.chance(0.3) ? 0 : 0.1));
    if (name == "sphere") return lightRow(sphere(centre, size));
    if (name == "triangle") return lightRow(triangle(random, centre, size));
    auto row = flat<RectangleRow>(random, centre, size);
    setSpread(row, spread);
    return name == "rectangle" ? lightRow(row) : lightRow(DiskRow{{row}});
}

} // namespace

TEST(light_lanes_equal_one_lane) {
    constexpr std::uint64_t kSeed = 5160;
    Random random(kSeed);
    const Environment sky(skyImage(random, 40, 20, 1), ColorSpace::Linear,
                          Interpolation::Bilinear, Environment::Up::Y, 0.3);
    std::vector<float> luminance(40 * 20);
    for (float& l : luminance) l = static_cast<float>(random.logUniform(1e-3, 10));
    const SkyTable table(40, 20, luminance, true, {false, 0.3});
    const auto in = std::make_unique<Questions>();
    const auto expected = std::make_unique<Answers>(), found = std::make_unique<Answers>();
    const int rounds = check::scaled(12);
    int compared = 0;
    for (int round = 0; round < rounds; ++round) {
        std::vector<LightBounds> bounds;
        for (int i = 0; i < 100; ++i)
            bounds.push_back(boundsOf(
                anyLight(random, random.below(static_cast<std::uint32_t>(lightKinds().size())))));
        bounds.push_back(boundsOfSky(1));
        const LightPicker picker(bounds);
        for (in->kind = 0; in->kind < lightKinds().size(); ++in->kind) {
            in->tree = picker.view(), in->sky = table.view({&sky, {1, 0.5f, 2}});
            for (std::size_t k = 0; k < kPoints; ++k) {
                const LightRow row = anyLight(random, in->kind);
                for (std::size_t i = 0; i < kLightNumbers; ++i) in->numbers[i][k] = row.numbers[i];
                // Near some lamps, at the place of others, and far away.
                const Vec3 near{row.numbers[0], row.numbers[1], row.numbers[2]};
                const Vec3 p = k % 16 == 0 ? near
                               : k % 2 == 0
                                   ? near + toFloat(random.inBox(random.logUniform(1e-3, 10)))
                                   : toFloat(random.inBox(2));
                const Vec3 n = random.chance(0.1) ? Vec3{} : unitVector(random);
                const Vec3 dir = unitVector(random);
                for (std::size_t c = 0; c < 3; ++c)
                    in->p[c][k] = p[c], in->n[c][k] = n[c], in->dir[c][k] = dir[c];
                const auto bits = [&] {
                    return static_cast<std::uint32_t>(random.unit() * 0x1p32);
                };
                in->u[k] = unitFloat(bits()), in->v[k] = unitFloat(bits());
                in->bits[k] = bits(), in->light[k] = random.below(bounds.size());
            }
            kernels::one::answer(*in, *expected);
            for (const Form& form : kForms) {
                if (!form.isThere()) continue;
                form.answer(*in, *found);
                CHECK_EQUAL(found->count, expected->count);
                for (std::size_t row = 0; row < found->count; ++row)
                    for (std::size_t k = 0; k < kPoints; ++k, ++compared)
                        CHECK_INFO(found->rows[row][k] == expected->rows[row][k],
                                   "seed " << kSeed << ' ' << form.name << ' '
                                           << lightKinds()[in->kind].name << " answer " << row
                                           << " of point " << k << ": " << std::hex
                                           << found->rows[row][k] << ", expected "
                                           << expected->rows[row][k]);
            }
        }
    }
    std::printf("%d answers of all widths compared\n", compared);
}

} // namespace test_light_lanes
