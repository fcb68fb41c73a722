// SceneDesc: what a scene file says, as plain data in double precision. Every reader makes one,
// --convert writes one, scene/scene.cpp turns one into something that can be traced.
// Knows nothing about tracing. Defaults live here, so that a missing line means the same in every
// format. Lengths are in scene units (metres), angles in degrees as written, light is linear RGB.
#pragma once

#include "base/one_or_more.h"
#include "base/raw_vector.h"
#include "base/seldom.h"
#include "base/vec.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

// Byte offset in the scene file, for messages. Where a thing was written is not part of what it
// says: two locations always compare equal.
struct SourceLoc {
    std::uint32_t offset = kUnknown;
    static constexpr std::uint32_t kUnknown = std::numeric_limits<std::uint32_t>::max();
    constexpr bool operator==(const SourceLoc&) const { return true; }
};

// Three rows of four numbers: world = rows * (x, y, z, 1).
using Rows = std::array<double, 12>;
inline constexpr Rows kIdentityRows = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
// Keys of a moving thing, equally spaced from shutter opening to closing; one key stands still.
using Keys = OneOrMore<Rows>;

struct Rgbd {
    double r = 0, g = 0, b = 0;
    bool operator==(const Rgbd&) const = default;
};

// A reference into one of the vectors of SceneDesc; kNone when there is none.
using Handle = std::int32_t;
inline constexpr Handle kNone = -1;

// What a block of a scene is; its word in enum_tables.h, its properties in properties.h. Enums of
// blocks have one byte, so that code can store them that has forgotten their types.
enum class BlockType { Settings, World, Camera, Texture, Material, Light, Mesh, Object };

struct TextureDesc {
    static constexpr auto kType = BlockType::Texture;
    enum class Space : std::uint8_t { Srgb, Linear };
    enum class Interpolation : std::uint8_t { Bilinear, Nearest };
    enum class Extension : std::uint8_t { Repeat, Extend, Clip };
    // Alpha: the file's alpha channel as a grey picture.
    enum class Channel : std::uint8_t { Color, Alpha };
    std::string name;
    SourceLoc loc, fileLoc;
    std::string file; // relative to the scene file, then to --textures and ./Textures
    Space space = Space::Srgb;
    Interpolation interpolation = Interpolation::Bilinear;
    Extension extension = Extension::Repeat;
    Channel channel = Channel::Color;
    // uv -> rotate(scale * uv) + offset, as Blender's Mapping node of type Point.
    Vec2d scale{1, 1};
    double rotationDeg = 0;
    Vec2d offset{0, 0};
    bool operator==(const TextureDesc&) const = default;
};

// One way in which a surface scatters light: a row of lobeTypes() (material/lobe_types.h) with its
// numbers. lobeForms() (desc/lobes.h) has one of each type that says nothing but that.
struct LobeDesc {
    static constexpr std::size_t kNumbers = 12, kMost = 8; // of a lobe; of a material's lobes
    // A picture that multiplies the weight or a field; numbers are multiplied by its grey.
    struct Factor {
        static constexpr std::int8_t kWeight = -1;
        std::int8_t field = kWeight; // its row in the type's fields
        bool without = false;        // by 1 - strength * picture instead
        Handle texture = kNone;
        double strength = 1;
        bool operator==(const Factor&) const = default;
    };
    SourceLoc loc;
    std::uint32_t kind = 0; // its row in lobeTypes()
    bool covers = false;    // lies on those behind it, which get what it lets through
    Rgbd weight{1, 1, 1};
    std::array<double, kNumbers> numbers{}; // the fields', one behind the other
    std::vector<Factor> factors;            // of the weight, then of each field in their order
    bool operator==(const LobeDesc&) const = default;
};

struct MaterialDesc {
    static constexpr auto kType = BlockType::Material;
    // Blinn: specular * (N.H)^exponent, unnormalised. Ashikhmin: normalised, energy conserving.
    // Phong: specular * (R.V)^exponent with R the mirrored direction to the light, unnormalised.
    enum class SpecularModel : std::uint8_t { Blinn, Ashikhmin, Phong };
    // How mirror and transmission share the light. None: as written. Dielectric: exact Fresnel by
    // ior (mirror*F, transmission*(1-F)). Schlick: mirror + (1-mirror)(1-cos)^5.
    enum class Fresnel : std::uint8_t { None, Dielectric, Schlick };
    // Which lamps a surface answers: those on the side from which it is seen, or those outside of
    // it, also when its inside is seen (COMP 557 never turns normals to the eye).
    enum class LitSide : std::uint8_t { Eye, Outside };
    enum class Sides : std::uint8_t { Both, Front };
    std::string name;
    SourceLoc loc;
    SpecularModel specularModel = SpecularModel::Blinn;
    Fresnel fresnel = Fresnel::None;
    LitSide litSide = LitSide::Eye;
    bool emissionLights = false; // Whitted: lights others too, instead of being seen only
    Sides emissionSides = Sides::Both;
    // Pictures multiply the number of their name.
    Handle diffuseTexture = kNone, specularTexture = kNone, emissionTexture = kNone,
           opacityTexture = kNone;
    Handle normalMap = kNone; // tangent space, +Y up
    Handle bumpMap = kNone;
    Rgbd diffuse{0.8, 0.8, 0.8}; // reflectance
    Rgbd specular{0, 0, 0};
    double exponent = 50;
    Rgbd mirror{0, 0, 0};       // traced reflection
    Rgbd transmission{0, 0, 0}; // traced refraction
    double ior = 1.5;
    double roughness = 0;   // 0 sharp; spreads mirror and transmission, Blender's scale
    Rgbd emission{0, 0, 0}; // radiance
    double opacity = 1;     // 1 - opacity of the light goes straight through, tinted by filter
    Rgbd filter{1, 1, 1};
    double normalStrength = 1;
    double bumpStrength = 1;
    double bumpDistance = 1; // height of a white texel over a black one
    std::vector<LobeDesc> lobes; // besides those that the numbers above are the short way to write
    bool operator==(const MaterialDesc&) const = default;
};

struct LightDesc {
    static constexpr auto kType = BlockType::Light;
    // All sit at the origin of their transform; spot, sun and the flat ones shine along its -Z.
    enum class Kind : std::uint8_t { Point, Spot, Sun, Rectangle, Disk, Sphere };
    std::string name;
    SourceLoc loc;
    Kind kind = Kind::Point;
    Rows worldFromLight = kIdentityRows;
    // Point, Spot: radiant intensity [W/sr]. Sun: irradiance [W/m^2] on a facing surface.
    // Rectangle, Disk, Sphere: radiance [W/(m^2 sr)].
    Rgbd color{1, 1, 1};
    // Point, Spot: irradiance at distance d is color / (x d^2 + y d + z) on a facing surface.
    Vec3d attenuation{1, 0, 0};
    double radius = 0; // Sphere: its radius. Point, Spot: soft-shadow disk facing the receiver
    Vec2d size{1, 1};  // Rectangle: sides. Disk: diameters (an ellipse when they differ)
    double coneAngleDeg = 45;   // Spot: full opening angle
    double blend = 0.15;        // Spot: soft part of the cone, 0 hard to 1
    bool cosineFalloff = false; // Spot: also multiplied by the cosine to its axis
    double angleDeg = 0;        // Sun: full angular diameter
    double spreadDeg = 180;     // Rectangle, Disk: emission cone
    bool shadows = true;
    bool visible = false; // Rectangle, Disk, Sphere: a body that camera, mirror and glass see
    // Lamps of any size that are not visible: these rays take their light along, and go on.
    // Reflections are those of sharp mirrors and glass.
    enum class SeenBy : std::uint8_t { None, Camera, Reflections, All };
    SeenBy seenBy = SeenBy::None;
    bool operator==(const LightDesc&) const = default;
};

struct CameraDesc {
    static constexpr auto kType = BlockType::Camera;
    enum class Kind : std::uint8_t { Perspective, Orthographic };
    enum class SensorFit : std::uint8_t { Auto, Horizontal, Vertical };
    std::string name;
    SourceLoc loc;
    Kind kind = Kind::Perspective;
    Keys worldFromCamera{kIdentityRows}; // looks along -Z, +Y up; scale in it is ignored
    double lensMm = 50;
    double sensorWidthMm = 36, sensorHeightMm = 24;
    SensorFit sensorFit = SensorFit::Auto;
    double shiftX = 0, shiftY = 0; // in units of the fitted side
    double orthoScale = 6;         // length of the fitted side
    double clipStart = 0;          // depth along the view axis where rays start
    double apertureRadius = 0;     // of the lens; 0 is a pinhole
    double focusDistance = 10;     // depth of the sharp plane along the view axis
    int apertureBlades = 0;        // below 3: a disk
    double apertureRotationDeg = 0;
    double apertureRatio = 1; // anamorphic: lens x is divided by it
    bool operator==(const CameraDesc&) const = default;
};

// Triangles with shared vertices; normals and uvs have their own indices, three per triangle, or
// are empty (flat shading, no texture coordinates).
struct MeshDesc {
    static constexpr auto kType = BlockType::Mesh;
    using Corners = std::array<std::uint32_t, 3>;
    std::string name;
    SourceLoc loc;
    // What the arrays are to be read from; load() does it and leaves `file` empty.
    std::string file;
    SourceLoc fileLoc;
    // Of the file's: edges that bend less are shaded smooth; 0 flat, -1 with the file's normals.
    double smoothAngleDeg = -1;
    RawVector<Vec3d> points;
    RawVector<Corners> triangles;
    RawVector<Vec3> normals;
    RawVector<Corners> normalTriangles;
    RawVector<Vec2> uvs;
    RawVector<Corners> uvTriangles;
    RawVector<std::uint32_t> triangleMaterials; // slot per triangle; empty: all use slot 0
    bool operator==(const MeshDesc&) const = default;
};

// The square in z = 0, from -1 to 1.
inline constexpr std::array<Vec3d, 4> kSquareCorners = {Vec3d{-1, -1, 0}, Vec3d{1, -1, 0},
                                                        Vec3d{1, 1, 0}, Vec3d{-1, 1, 0}};

// Scenes have millions of them: what is short stands together, what is rare elsewhere.
struct ObjectDesc {
    static constexpr auto kType = BlockType::Object;
    // In object space: Sphere radius `radius` about the origin. Cube [-1,1]^3. Plane: the four
    // `corners` in order. InfinitePlane z = 0. Disk `radius` in z = 0. Cylinder |z| <= 1, `radius`.
    // Cone: `radius` at z = -1 to `topRadius` at z = 1. Mesh: `mesh`.
    enum class Kind : std::uint8_t {
        Sphere,
        Cube,
        Plane,
        InfinitePlane,
        Disk,
        Cylinder,
        Cone,
        Mesh
    };
    // Front is the outside, +Z of flat shapes. Rays of sight (camera, mirror, glass) pass through a
    // side that is not there; shadows fall from both.
    enum class Sides : std::uint8_t { Both, Front, Back };
    std::string name;
    SourceLoc loc;
    Kind kind = Kind::Sphere;
    Sides sides = Sides::Both;
    bool caps = true; // Cylinder, Cone
    Keys worldFromObject{kIdentityRows};
    // Mesh: by slot. InfinitePlane: two alternate on the unit squares of its x and y, the first
    // where floor(x) + floor(y) is even. Others: the first. Empty: the default material.
    OneOrMore<Handle> materials;
    double radius = 1;
    double topRadius = 0;
    Seldom<std::array<Vec3d, 4>, kSquareCorners> corners;
    Handle mesh = kNone;
    bool operator==(const ObjectDesc&) const = default;
};

struct WorldDesc {
    static constexpr auto kType = BlockType::World;
    SourceLoc loc;
    Rgbd background{0, 0, 0};   // radiance where no surface is
    Rgbd ambient{0, 0, 0};      // reaches every surface: adds diffuse * ambient
    Handle environment = kNone; // equirectangular picture, multiplied by background
    enum class Up : std::uint8_t { Z, Y };
    Up environmentUp = Up::Z; // axis through the upper edge of the environment
    double rotationDeg = 0;   // of the environment about that axis
    bool environmentLights = false; // Whitted: background and environment light as a lamp does
    double ambientOcclusion = 0;    // ambient counts by the sky seen up to here; 0 all of it
    bool operator==(const WorldDesc&) const = default;
};

struct SettingsDesc {
    static constexpr auto kType = BlockType::Settings;
    // Corners: rays through the corners of the pixels, each shared by the four pixels around it.
    enum class Sampler : std::uint8_t { Sobol, Stratified, Random, Grid, Corners, ZSobol };
    enum class Filter : std::uint8_t { Box, Tent, Gaussian, BlackmanHarris };
    enum class Transfer : std::uint8_t { Srgb, Linear };
    enum class TextureFilter : std::uint8_t { Mip, None };
    enum class Integrator : std::uint8_t { Whitted, Path, Ao, Normal, Depth, Albedo, Id, Uv };
    SourceLoc loc;
    Integrator integrator = Integrator::Whitted;
    int width = 960, height = 540;
    Vec2d pixelAspect{1, 1};
    std::optional<std::array<int, 4>> crop; // x0 y0 x1 y1, from the top left, x1 y1 exclusive
    int samplesPerPixel = 16;
    int lightSamples = 1;
    int maxDepth = 8;           // bounces after the camera ray
    // Path tracing limits bounces by each kind of lobe, too, and rays straight on through opacity.
    int diffuseDepth = 4, glossyDepth = 4, transmissionDepth = 12, transparentDepth = 8;
    double filterGlossy = 0;    // path tracing: Cycles' Filter Glossy, 0 off
    double clampIndirect = 0;   // path tracing: the most radiance behind the first bounce; 0 any
    bool caustics = true;       // path tracing: diffuse light by way of mirrors and glass
    double cutoff = 1.0 / 2048; // rays that change no pixel by more than this are not traced
    bool denoise = false;
    Sampler sampler = Sampler::Sobol;
    bool jitter = true;
    std::uint32_t seed = 0;
    Filter filter = Filter::BlackmanHarris;
    double filterWidth = 1.5; // pixels, whole support
    // Mip: pictures and checkers are seen as their mean over what a sample stands for.
    TextureFilter textureFilter = TextureFilter::Mip;
    double exposureEv = 0;    // picture * 2^EV
    Transfer transfer = Transfer::Srgb;
    bool operator==(const SettingsDesc&) const = default;
};

struct SceneDesc {
    SettingsDesc settings;
    WorldDesc world;
    std::vector<CameraDesc> cameras; // the first one is the active one
    std::vector<TextureDesc> textures;
    std::vector<MaterialDesc> materials;
    std::vector<LightDesc> lights;
    std::vector<MeshDesc> meshes;
    std::vector<ObjectDesc> objects;
    bool operator==(const SceneDesc&) const = default;
};
