// Writing and reading back gives an equal scene: for every property of the tables, and for random
// scenes.
#include "desc/write_txt.h"

#include "base/text.h"
#include "check.h"
#include "desc/lobes.h"
#include "desc/properties.h"
#include "read/txt/read_txt.h"

#include <bit>
#include <cmath>
#include <random>

namespace test_write_txt {

namespace {

// Fills blocks by walking the tables, so that a new row is tested without a new line here.
class RandomScene {
public:
    RandomScene(std::uint64_t seed, double chance) : random_(seed), chance_(chance) {}

    SceneDesc make(std::size_t perKind) {
        for (std::size_t i = 0; i < perKind; ++i) {
            desc_.textures.emplace_back().name = name("texture", i);
            desc_.materials.emplace_back().name = name("material", i);
            desc_.meshes.emplace_back().name = name("mesh", i);
            desc_.lights.emplace_back().name = name("light", i);
            desc_.cameras.emplace_back().name = name("camera", i);
            for (const auto kind : kValuesOf<ObjectDesc::Kind>) {
                ObjectDesc& object = desc_.objects.emplace_back();
                object.name = name(nameOf(kind), i);
                object.kind = kind;
                object.worldFromObject = keys();
            }
        }
        for (LightDesc& light : desc_.lights) light.worldFromLight = rows();
        for (CameraDesc& camera : desc_.cameras) camera.worldFromCamera = keys();
        forEachBlock(desc_, [&](auto& block) { fill(block); });
        for (MaterialDesc& material : desc_.materials)
            while (material.lobes.size() < LobeDesc::kMost && chance(chance_ * 0.8))
                material.lobes.push_back(lobe());
        return desc_;
    }

private:
    bool chance(double p) { return std::uniform_real_distribution<double>(0, 1)(random_) < p; }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

    std::string name(std::string_view kind, std::size_t i) {
        static const std::vector<std::string> kEndings = {
            "", ".001", " with blanks", " \"quoted\"", " back\\slash", " größer 大 🎈", " # { }"};
        return cat(kind, i, kEndings[below(kEndings.size())]);
    }
    double number(const Range& range) {
        switch (below(4)) {
        case 0: return range.hi;
        case 1: return range.aboveLo ? std::min(range.hi, 1e-30) : range.lo;
        default: {
            const double lo = std::max(range.lo, -1000.0), hi = std::min(range.hi, 1000.0);
            const double value = std::uniform_real_distribution<double>(lo, hi)(random_);
            return range.contains(value) ? value : range.hi;
        }
        }
    }
    Rows rows() {
        Rows rows{};
        for (double& x : rows) x = std::ldexp(number({-1, 1}), static_cast<int>(below(80)) - 40);
        return rows;
    }
    Keys keys() {
        Keys keys(1 + below(3), kIdentityRows);
        for (Rows& key : keys)
            if (chance(0.8)) key = rows();
        return keys;
    }

    template <class Block> void fill(Block& block) {
        static const Block kDefaults{};
        for (const Property& property : propertiesOf(Block::kType)) {
            if (std::is_same_v<Block, ObjectDesc> && !(property.kinds & AnyBlock(block).kind)) continue;
            if (!chance(chance_)) continue;
            int tries = 0; // again when the default was met
            do fill(property, &block);
            while (++tries < 50 && isSame(property, &block, &kDefaults));
        }
    }
    void fill(const Property& property, void* block) {
        std::array<double, kMostNumbers> numbers{};
        for (std::size_t i = 0; i < property.numberCount(); ++i) {
            numbers[i] = number(property.range);
            if (property.isWhole()) numbers[i] = std::trunc(numbers[i]);
        }
        setNumbers(property, block, numbers.data());
        const Field& field = property.first;
        switch (field.kind) {
        case FieldKind::Flag: at<bool>(field, block) = chance(0.5); break;
        case FieldKind::Text: at<std::string>(field, block) = name("file", 0); break;
        case FieldKind::Choice:
            at<std::uint8_t>(field, block) = static_cast<std::uint8_t>(below(field.names.size()));
            break;
        case FieldKind::Name: at<Handle>(field, block) = handle(); break;
        case FieldKind::Material:
        case FieldKind::Materials:
            at<OneOrMore<Handle>>(field, block)
                .assign(field.kind == FieldKind::Materials ? 1 + below(3) : 1, handle());
            break;
        default: break;
        }
    }
    LobeDesc lobe() {
        const LobeForm& form = lobeForms()[below(lobeForms().size())];
        LobeDesc lobe = form.usual;
        lobe.covers = chance(0.3);
        if (chance(0.5)) lobe.weight = {number(kColor), number(kUnit), 1};
        for (const LobeFieldForm& field : form.fields)
            if (chance(0.5))
                for (std::size_t i = 0; i < field.count; ++i)
                    lobe.numbers[field.first + i] = number(field.range);
        const int fields = static_cast<int>(form.fields.size());
        for (int field = int{LobeDesc::Factor::kWeight}; field < fields; ++field)
            while (chance(0.3)) {
                auto& factor = lobe.factors.emplace_back();
                factor.field = static_cast<std::int8_t>(field);
                factor.texture = handle();
                factor.without = chance(0.5);
                if (factor.without && chance(0.5)) factor.strength = number(kFactorStrength);
            }
        return lobe;
    }
    Handle handle() { return static_cast<Handle>(below(desc_.materials.size())); }

    void fill(MeshDesc& mesh) {
        if (chance(0.3)) {
            mesh.file = name("file", 0);
            mesh.smoothAngleDeg = number({0, 180});
            return;
        }
        const std::size_t points = 3 + below(10);
        const auto single = [&] {
            return static_cast<float>(
                std::ldexp(number({-1, 1}), static_cast<int>(below(100)) - 60));
        };
        for (std::size_t i = 0; i < points; ++i) {
            mesh.points.push_back({number(kAnyNumber), number(kAnyNumber), number({-1, 1})});
            mesh.normals.push_back({single(), single(), single()});
            mesh.uvs.push_back({single(), single()});
        }
        const auto index = [&] { return static_cast<std::uint32_t>(below(points)); };
        const std::size_t count = 1 + below(10);
        for (std::size_t i = 0; i < count; ++i) {
            mesh.triangles.push_back({index(), index(), index()});
            mesh.normalTriangles.push_back({index(), index(), index()});
            mesh.uvTriangles.push_back({index(), index(), index()});
            mesh.triangleMaterials.push_back(index());
        }
        if (chance(0.3)) mesh.normals.clear(), mesh.normalTriangles.clear();
        if (chance(0.3)) mesh.uvs.clear(), mesh.uvTriangles.clear();
        if (chance(0.3)) mesh.triangleMaterials.clear();
    }

    std::mt19937_64 random_;
    double chance_;
    SceneDesc desc_;
};

SceneDesc readBack(const std::string& text) { return readTxt({"written.txt", text}); }

// Every row of a table must have a block in which its value is not the default.
template <class Block>
void checkAllUsed(const std::vector<Block>& blocks, const std::string& text) {
    static const Block kDefaults{};
    for (const Property& property : propertiesOf(Block::kType)) {
        bool used = false;
        for (const Block& block : blocks)
            used = used ||
                   ((property.kinds & AnyBlock(block).kind) && !isSame(property, &block, &kDefaults));
        CHECK_INFO(used, "no block uses " << property.keyword);
        CHECK_INFO(text.find(cat("\n    ", property.keyword, " ")) != std::string::npos,
                   property.keyword << " was not written");
    }
}

} // namespace

TEST(write_txt_every_property_comes_back) {
    const SceneDesc desc = RandomScene(1, 1.0).make(12);
    const std::string text = writeTxt(desc);
    CHECK(readBack(text) == desc);
    checkAllUsed(std::vector{desc.settings}, text);
    checkAllUsed(std::vector{desc.world}, text);
    checkAllUsed(desc.cameras, text);
    checkAllUsed(desc.textures, text);
    checkAllUsed(desc.materials, text);
    checkAllUsed(desc.lights, text);
    checkAllUsed(desc.meshes, text);
    checkAllUsed(desc.objects, text);
    forEachArray(desc.meshes[0], [&](std::string_view keyword, auto&, std::string_view) {
        CHECK_INFO(text.find(cat("\n    ", keyword, " ")) != std::string::npos, keyword);
    });
    for (const auto kind : kNamesByValue<ObjectDesc::Kind>)
        CHECK_INFO(text.find(cat("\n", kind, " ")) != std::string::npos, kind);
}

TEST(write_txt_every_lobe_comes_back) {
    const SceneDesc desc = RandomScene(3, 1.0).make(64);
    const std::string text = writeTxt(desc);
    CHECK(readBack(text) == desc);
    for (const LobeForm& form : lobeForms()) {
        CHECK_INFO(text.find(cat("\n    lobe ", form.name, " ")) != std::string::npos, form.name);
        for (const LobeFieldForm& field : form.fields)
            CHECK_INFO(text.find(cat(" ", field.name, " ")) != std::string::npos, field.name);
    }
    for (const std::string_view word : {" times ", " without ", " covers\n"})
        CHECK_INFO(text.find(word) != std::string::npos, word);
}

// What is as it starts is left out, and a diffuse surface is said where there are lobes.
TEST(write_txt_short_lobes) {
    SceneDesc desc;
    desc.textures.emplace_back().name = "wood grain";
    MaterialDesc& material = desc.materials.emplace_back();
    material.name = "m";
    const auto named = [](std::string_view name) {
        for (const LobeForm& form : lobeForms())
            if (form.name == name) return form.usual;
        return LobeDesc{};
    };
    material.lobes = {named("conductor"), named("coat"), named("diffuse")};
    material.lobes[1].covers = true;
    material.lobes[2].factors = {{.texture = 0}, {.without = true, .texture = 0, .strength = 0.25}};
    const auto written = [&] {
        const std::string text = writeTxt(desc);
        CHECK(readBack(text) == desc);
        return text.substr(text.find("material m"));
    };
    const std::string lobes =
        "    lobe conductor\n    lobe coat covers\n    lobe diffuse weight 1 1 1 "
        "times \"wood grain\" without \"wood grain\" 0.25\n}\n";
    CHECK_EQUAL(written(), "material m {\n    diffuse 0.8 0.8 0.8\n" + lobes);
    material.diffuse = {};
    CHECK_EQUAL(written(), "material m {\n" + lobes);
}

TEST(write_txt_random_scenes_come_back) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const SceneDesc desc = RandomScene(seed, 0.4).make(1 + seed % 4);
        const std::string text = writeTxt(desc);
        const SceneDesc again = readBack(text);
        CHECK_INFO(again == desc, "seed " << seed << "\n" << text);
        CHECK_INFO(writeTxt(again) == text, "seed " << seed << ": written twice, not the same");
    }
}

TEST(write_txt_keeps_bits) {
    SceneDesc desc;
    MeshDesc& mesh = desc.meshes.emplace_back();
    mesh.name = "m";
    std::mt19937_64 random(2);
    while (mesh.points.size() < 10000) {
        const Vec3d p{std::bit_cast<double>(random()), -0.0, 0x1p-1074};
        const Vec3 n{std::bit_cast<float>(static_cast<std::uint32_t>(random())), -0.0f, 0x1p-149f};
        if (!(std::fabs(p.x) <= kLargestLength && std::fabs(n.x) <= 1e15f)) continue;
        mesh.points.push_back(p);
        mesh.normals.push_back(n);
    }
    const SceneDesc again = readBack(writeTxt(desc));
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            CHECK(std::bit_cast<std::uint64_t>(again.meshes[0].points[i][axis]) ==
                  std::bit_cast<std::uint64_t>(mesh.points[i][axis]));
            CHECK(std::bit_cast<std::uint32_t>(again.meshes[0].normals[i][axis]) ==
                  std::bit_cast<std::uint32_t>(mesh.normals[i][axis]));
        }
}

TEST(write_txt_leaves_defaults_out) {
    SceneDesc desc;
    desc.cameras.emplace_back().name = "c";
    desc.objects.emplace_back().name = "two words";
    const std::string text = writeTxt(desc);
    CHECK(text.starts_with("raytracer 1\n#"));
    CHECK(text.ends_with("\ncamera c {\n}\n\nsphere \"two words\" {\n}\n"));
    CHECK(text.find("settings") == std::string::npos);
    desc.settings.samplesPerPixel = 3;
    CHECK(writeTxt(desc).find("settings {\n    samples 3\n}\n") != std::string::npos);
}

} // namespace test_write_txt
