#include "course_scenes.h"

#include "base/text.h"
#include "base/vec.h"

#include <random>
#include <vector>

namespace {

// JSON in the making. Values are evaluated from left to right inside the braces of a list, which
// arguments of a function are not.
using Members = std::vector<std::string>;

std::string json(double value) { return shortest(value); }
std::string json(const std::string& text) { return cat('"', text, '"'); }
std::string json(Vec3d v) {
    return cat('[', shortest(v.x), ", ", shortest(v.y), ", ", shortest(v.z), ']');
}
std::string array(const Members& values) { return cat("[\n", join(values, ",\n"), "]"); }
std::string member(const std::string& key, const std::string& value) {
    return cat('"', key, "\": ", value);
}
template <class Value> std::string member(const std::string& key, const Value& value) {
    return member(key, json(value));
}
std::string text(const std::string& key, const std::string& value) {
    return member(key, json(value));
}
std::string object(Members members) {
    std::erase(members, ""); // what a dialect does not have
    return cat("{", join(members), "}");
}

class Author {
public:
    explicit Author(std::uint32_t seed) : random_(seed), old_(seed % 3 == 0), new_(seed % 3 == 2) {}

    std::string scene() {
        Members materials, lights;
        for (int i = 0; i < kMaterials; ++i) materials.push_back(material(i));
        Members objects{floor()};
        for (int i = whole(3, 6); i > 0; --i) objects.push_back(shape(2));
        objects.push_back(node(1, 2.5));
        const std::string named = cat('n', names_); // the outer node takes its name last
        for (int i = whole(1, 2); i > 0; --i) objects.push_back(instance(named));
        for (int i = whole(1, 3); i > 0; --i) lights.push_back(light());
        const double samples = new_ ? 1 : whole(1, 2);
        return object({member("resolution", std::string("[64, 48]")),
                       member("ambient", vec3(0, 0.3)),
                       old_ ? member("AA", object({member("samples", samples)}))
                            : member("AA_samples", samples),
                       member("camera", camera()), member("materials", array(materials)),
                       member("objects", array(objects)), member("lights", array(lights))});
    }

private:
    static constexpr int kMaterials = 5;

    int whole(int low, int high) {
        return low + static_cast<int>(random_() % static_cast<std::uint32_t>(high - low + 1));
    }
    bool chance(int percent) { return whole(1, 100) <= percent; }
    // Thousandths, so that the text is short.
    double number(double low, double high) {
        return whole(static_cast<int>(low * 1000), static_cast<int>(high * 1000)) / 1000.0;
    }
    Vec3d vec3(double low, double high) {
        return {number(low, high), number(low, high), number(low, high)};
    }

    std::string camera() {
        return object({member("position", Vec3d{number(-6, 6), number(4, 6), number(5, 7)}),
                       member("lookAt", vec3(-1, 0)),
                       member("up", Vec3d{number(-0.3, 0.3), 1, 0.1}),
                       member(new_ ? "fovy" : "fov", number(35, 50))});
    }

    std::string material(int i) {
        return object({text("name", cat('m', i)), old_ ? member("ID", double(i)) : "",
                       member("diffuse", vec3(0.1, 1)),
                       member("specular", vec3(0, chance(70) ? 0.8 : 0)),
                       member(old_ ? "hardness" : "shininess", number(0, 60))});
    }
    std::string anyMaterial() {
        const int i = whole(0, kMaterials - 1);
        return old_ ? json(i) : json(cat('m', i));
    }
    std::string materials(int count) {
        Members names;
        while (count-- > 0) names.push_back(anyMaterial());
        return member("materials", array(names));
    }

    std::string name() { return text("name", cat('n', ++names_)); }
    std::string position(double reach) { return member("position", vec3(-reach, reach)); }
    std::string rotation() { return member("rotation", vec3(-180, 180)); }
    std::string scale() { return member("scale", vec3(0.4, 1.3)); }

    std::string floor() {
        return object({name(), text("type", "plane"),
                       member("position", Vec3d{number(-1, 1), number(-2, -1.2), number(-1, 1)}),
                       member("normal", Vec3d{number(-0.1, 0.1), number(0.5, 2), 0.05}),
                       materials(chance(70) ? 2 : 1)});
    }

    std::string shape(double reach, int materialCount = 1) {
        Members members{name(), materials(materialCount)};
        const int kind = whole(1, 10);
        const bool isMesh = kind == 10, isBox = kind >= 6 && !isMesh;
        if (isBox) {
            const bool sized = old_ && chance(50);
            if (sized) members.push_back(member("size", vec3(0.4, 1.8)));
            if (!sized) members.push_back(member("min", vec3(-reach, 0)));
            if (!sized) members.push_back(member("max", vec3(0.1, reach / 2)));
        }
        members.push_back(text("type", isMesh ? "mesh" : isBox ? "box" : "sphere"));
        if (isMesh) members.push_back(text("filepath", "tests/scenes/json/meshes/gem.obj"));
        if (!isMesh && !isBox) members.push_back(member("radius", number(0.3, 0.9)));
        // The box of F2024 is the one shape that nothing places.
        if (!isBox || old_ || new_) members.push_back(position(reach));
        if (new_) members.insert(members.end(), {rotation(), scale()});
        if (!new_ && isMesh) members.push_back(member("scale", number(0.5, 1.2)));
        return object(members);
    }

    std::string node(int deeper, double reach) {
        Members children{shape(0.8), shape(0.8, 0)};
        if (deeper > 0) children.push_back(node(deeper - 1, 0.9));
        return object({name(), text("type", "node"), position(reach), rotation(), scale(),
                       materials(1), old_ ? text("ref", "") : "",
                       member("children", array(children))});
    }
    std::string instance(const std::string& ref) {
        return object({name(), text("type", old_ ? "node" : "instance"), position(2), rotation(),
                       scale(), materials(1), text("ref", ref)});
    }

    std::string light() {
        const std::string colour = member("colour", vec3(0.2, 0.9));
        if (chance(25)) {
            const Vec3d direction = old_ ? Vec3d{0.48, 0.64, 0.6} : Vec3d{number(-2, 2), 1.5, 0.7};
            return object({text("name", "sun"), text("type", "directional"), colour,
                           member("direction", direction)});
        }
        const bool isBelow = chance(15);
        const double height = isBelow ? number(-5, -3) : number(4, 8);
        const bool fades = !old_ && chance(60);
        const bool dims = !old_ && !new_ && !fades; // 1 / d^2
        const Vec3d fall{number(0.005, 0.02), number(0, 0.1), 0.2};
        return object({text("name", "lamp"), text("type", "point"), colour,
                       member("position", Vec3d{number(-6, 6), height, number(3, 6)}),
                       member("power", dims ? number(15, 60) : number(0.3, 1.2)),
                       fades ? member("attenuation", fall) : ""});
    }

    std::mt19937 random_;
    bool old_, new_;
    int names_ = 0;
};

} // namespace

std::string randomCourseScene(std::uint32_t seed) { return Author(seed).scene(); }
