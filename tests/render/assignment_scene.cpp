#include "assignment_scene.h"

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>

namespace assignment {

namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

const JsonValue& need(const JsonValue& object, const char* key) {
    if (const JsonValue* value = object.find(key)) return *value;
    throw std::runtime_error(std::string("missing '") + key + "'");
}
double number(const JsonValue& object, const char* key, double otherwise) {
    const JsonValue* value = object.find(key);
    return value ? value->number() : otherwise;
}
std::string text(const JsonValue& object, const char* key) {
    const JsonValue* value = object.find(key);
    return value ? std::string(value->text()) : "";
}
Vec3d vec3(const JsonValue& value) {
    const auto numbers = value.items();
    if (numbers.size() != 3) throw std::runtime_error("not three numbers");
    return {numbers[0].number(), numbers[1].number(), numbers[2].number()};
}
Vec3d vec3(const JsonValue& object, const char* key, Vec3d otherwise) {
    const JsonValue* value = object.find(key);
    return value ? vec3(*value) : otherwise;
}
std::span<const JsonValue> list(const JsonValue& object, const char* key) {
    const JsonValue* value = object.find(key);
    return value ? value->items() : std::span<const JsonValue>();
}

// The corners of "v" and "f" lines; of a corner "a/b/c" only the position; polygons as fans.
Mesh readMesh(const std::string& name, const std::string& folder) {
    std::ifstream file(name);
    if (!file) file.open(folder + "/" + name);
    if (!file) throw std::runtime_error("no mesh " + name);
    Mesh mesh;
    std::vector<Vec3d> points;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") {
            Vec3d p;
            words >> p.x >> p.y >> p.z;
            points.push_back(p);
        } else if (word == "f") {
            std::vector<Vec3d> corners;
            while (words >> word) corners.push_back(points.at(std::stoul(word) - 1));
            for (std::size_t k = 2; k < corners.size(); ++k)
                mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
        }
    }
    return mesh;
}

Affine translation(Vec3d by) {
    Affine out;
    out.origin = by;
    return out;
}
Affine turnX(double a) {
    return {{1, 0, 0}, {0, std::cos(a), std::sin(a)}, {0, -std::sin(a), std::cos(a)}, {}};
}
Affine turnY(double a) {
    return {{std::cos(a), 0, -std::sin(a)}, {0, 1, 0}, {std::sin(a), 0, std::cos(a)}, {}};
}
Affine turnZ(double a) {
    return {{std::cos(a), std::sin(a), 0}, {-std::sin(a), std::cos(a), 0}, {0, 0, 1}, {}};
}
Affine placing(const JsonValue& object) {
    const Vec3d turn = vec3(object, "rotation", {});
    const JsonValue* scale = object.find("scale");
    const bool equal = scale && scale->isNumber();
    const Vec3d s = equal ? Vec3d{1, 1, 1} * scale->number() : vec3(object, "scale", {1, 1, 1});
    return translation(vec3(object, "position", {})) * turnX(radians(turn.x)) *
           turnY(radians(turn.y)) * turnZ(radians(turn.z)) *
           Affine{{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}};
}

enum class Dialect { W2024, F2024, F2025 }; // W2024 is also the one of 2022

Dialect dialectOf(const JsonValue& scene) {
    if (need(scene, "camera").find("fovy")) return Dialect::F2025;
    if (scene.find("AA")) return Dialect::W2024;
    for (const JsonValue& material : list(scene, "materials"))
        if (material.find("ID")) return Dialect::W2024;
    return Dialect::F2024;
}

class Interpreter {
public:
    Interpreter(const JsonValue& scene, std::string folder)
        : dialect_(dialectOf(scene)), folder_(std::move(folder)) {
        readPicture(scene);
        for (const JsonValue& material : list(scene, "materials"))
            materials_[isOld() ? std::to_string(std::lround(need(material, "ID").number()))
                               : text(material, "name")] = {
                vec3(need(material, "diffuse")), vec3(need(material, "specular")),
                number(material, isOld() ? "hardness" : "shininess", 0)};
        for (const JsonValue& light : list(scene, "lights")) readLight(light);
        for (const JsonValue& object : list(scene, "objects")) {
            place(object, {}, {});
            named_[text(object, "name")] = &object;
        }
    }
    SceneData data;

private:
    bool isOld() const { return dialect_ == Dialect::W2024; }

    void readPicture(const JsonValue& scene) {
        const auto resolution = list(scene, "resolution");
        data.width =
            resolution.empty() ? (isOld() ? 1080 : 1280) : static_cast<int>(resolution[0].number());
        data.height = resolution.empty() ? 720 : static_cast<int>(resolution[1].number());
        const JsonValue* group = scene.find("AA");
        // Without jitter all AA_samples go through the centre of the pixel.
        data.samples = group ? static_cast<int>(number(*group, "samples", 1)) : 1;
        const double grey = isOld() ? 0.0 : 0.1;
        data.ambient = vec3(scene, "ambient", {grey, grey, grey});
        const JsonValue& camera = need(scene, "camera");
        data.eye = vec3(need(camera, "position"));
        data.lookAt = vec3(need(camera, "lookAt"));
        data.up = vec3(need(camera, "up"));
        data.fovDeg = need(camera, dialect_ == Dialect::F2025 ? "fovy" : "fov").number();
    }

    void readLight(const JsonValue& value) {
        Light light;
        light.isPoint = text(value, "type") == "point";
        light.colour = vec3(need(value, "colour"));
        light.attenuation = {0, 0, 1};
        if (light.isPoint || !isOld()) light.colour *= number(value, "power", 1);
        if (light.isPoint && dialect_ == Dialect::F2024) light.attenuation = {1, 0, 0};
        if (light.isPoint && !isOld())
            light.attenuation = vec3(value, "attenuation", light.attenuation);
        light.place = vec3(need(value, light.isPoint ? "position" : "direction"));
        if (!light.isPoint) light.place = normalize(light.place);
        data.lights.push_back(light);
    }

    std::vector<Material> materialsOf(const JsonValue& object) const {
        std::vector<Material> out;
        for (const JsonValue& name : list(object, "materials")) {
            const auto found =
                materials_.find(name.isNumber() ? std::to_string(std::lround(name.number()))
                                                : std::string(name.text()));
            if (found != materials_.end()) out.push_back(found->second);
        }
        return out;
    }

    // inherited: the material of the nodes around, if any.
    void place(const JsonValue& object, const Affine& around, std::optional<Material> inherited) {
        const std::string type = text(object, "type");
        std::vector<Material> own = materialsOf(object);
        if (!own.empty()) inherited = own[0];
        if (type == "instance") {
            place(*named_.at(text(object, "ref")), around * placing(object), inherited);
        } else if (type == "node") {
            // The whole of an old node is replaced but its children.
            const std::string ref = isOld() ? text(object, "ref") : "";
            const JsonValue& source = ref.empty() ? object : *named_.at(ref);
            for (const JsonValue& child : list(source, "children")) {
                place(child, around * placing(object), inherited);
                if (!isOld()) named_[text(child, "name")] = &child;
            }
        } else if (inherited) {
            if (own.empty()) own = {*inherited};
            own.resize(std::min<std::size_t>(own.size(), 2));
            placeShape(object, type, around, own);
        }
    }

    void placeShape(const JsonValue& object, const std::string& type, const Affine& around,
                    const std::vector<Material>& materials) {
        // In 2025 a position is part of M, before it is added to the shape's own numbers.
        const bool hasM = dialect_ == Dialect::F2025;
        const Affine m = hasM ? around * placing(object) : around;
        const Vec3d position = hasM ? Vec3d{} : vec3(object, "position", {});
        Object out{m, m.inverse(), {}, materials};
        if (type == "sphere") {
            out.shape = Sphere{position, number(object, "radius", 1)};
        } else if (type == "plane") {
            out.shape = Plane{position, vec3(object, "normal", {0, 1, 0})};
        } else if (type == "box") {
            const JsonValue* size = object.find("size");
            const Vec3d half = size ? vec3(*size) * 0.5 : Vec3d{1, 1, 1};
            if (isOld() && size)
                out.shape = Box{position - half, position + half};
            else
                out.shape = Box{vec3(object, "min", {-1, -1, -1}), vec3(object, "max", {1, 1, 1})};
        } else if (type == "mesh") {
            Mesh mesh = readMesh(text(object, "filepath"), folder_);
            const double scale = hasM ? 1 : number(object, "scale", 1);
            for (auto& triangle : mesh.triangles)
                for (Vec3d& corner : triangle) corner = (corner + position) * scale;
            out.shape = std::move(mesh);
        } else {
            throw std::runtime_error("unknown object type '" + type + "'");
        }
        data.objects.push_back(std::move(out));
    }

    Dialect dialect_;
    std::string folder_;
    std::map<std::string, Material> materials_;
    std::map<std::string, const JsonValue*> named_;
};

} // namespace

Affine Affine::inverse() const {
    // The rows of the inverse are the cross products of the columns over the determinant.
    const double det = dot(x, cross(y, z));
    const Vec3d a = cross(y, z) / det, b = cross(z, x) / det, c = cross(x, y) / det;
    return {{a.x, b.x, c.x},
            {a.y, b.y, c.y},
            {a.z, b.z, c.z},
            {-dot(a, origin), -dot(b, origin), -dot(c, origin)}};
}

SceneData interpret(const JsonValue& scene, const std::string& folder) {
    return Interpreter(scene, folder).data;
}

} // namespace assignment
