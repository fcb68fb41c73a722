#include "desc/validate.h"

#include "base/for_each.h"
#include "base/text.h"
#include "desc/check_block.h"
#include "desc/lobes.h"
#include "desc/names.h"
#include "desc/same_names.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace {

constexpr std::size_t kListed = 10;
// "a, b, c and 4 more"; `names` are at least the first kListed of `count`.
std::string listed(const std::vector<std::string>& names, std::size_t count) {
    const std::span<const std::string> all = names;
    const std::string head = join(all.first(std::min(names.size(), kListed)));
    return count > kListed ? cat(head, " and ", count - kListed, " more") : head;
}

class Validator {
public:
    Validator(const SceneDesc& desc, const SourceFile& source, Diagnostics& diagnostics,
              int threads)
        : desc_(desc), source_(source), diagnostics_(diagnostics), threads_(threads), used_(desc),
          slots_(materialSlots(desc)) {}

    void run() {
        all_.check(desc_.settings);
        all_.check(desc_.world);
        checkSettings();
        if (desc_.cameras.empty()) all_.wholes.add({}, [] { return "the scene has no camera"; });
        checkAll<&SceneDesc::cameras>();
        checkAll<&SceneDesc::textures>();
        checkAll<&SceneDesc::materials>();
        checkAll<&SceneDesc::lights>();
        checkAll<&SceneDesc::meshes>();
        checkAll<&SceneDesc::objects>();
        diagnostics_.warnings.insert(diagnostics_.warnings.end(), all_.warnings.begin(),
                                     all_.warnings.end());
        // Messages come in this order: of single properties, of names, of blocks as wholes.
        ErrorList all(source_);
        for (const ErrorList* some : {&all_.properties, &names_, &all_.wholes}) all.append(*some);
        all.throwIfAny();
        warnUnused();
        warnDark();
        warnBright();
        warnOfWeights();
        warnFar();
    }

private:
    template <class... Parts> void nameError(const AnyBlock& block, const Parts&... parts) {
        names_.add(block.loc, [&] { return cat(called(block), ": ", parts...); });
    }
    void warn(SourceLoc loc, std::string_view what) {
        diagnostics_.warnings.push_back(names_.locatedAt(loc, what, "warning"));
    }

    // A list of the scene whose type is forgotten.
    struct Blocks {
        std::size_t count;
        AnyBlock (*at)(const SceneDesc&, std::size_t);
        void (*check)(BlockChecker&, const SceneDesc&, std::size_t);
    };
    template <auto list> void checkAll() {
        checkBlocks(
            {(desc_.*list).size(),
             [](const SceneDesc& desc, std::size_t i) -> AnyBlock { return (desc.*list)[i]; },
             [](BlockChecker& checker, const SceneDesc& desc, std::size_t i) {
                 checker.check((desc.*list)[i]);
             }});
    }
    void checkBlocks(const Blocks& blocks) {
        constexpr std::size_t kTogether = 4096;
        struct Part {
            BlockChecker checker;
            std::vector<std::uint32_t> badNames;
        };
        const int perBlock = blocks.count == 1 ? threads_ : 1;
        std::vector<Part> parts((blocks.count + kTogether - 1) / kTogether,
                                {BlockChecker(desc_, source_, used_, slots_, perBlock), {}});
        SameNames same(blocks.count, kTogether);
        forEachPart(threads_, blocks.count, kTogether, [&](std::size_t first, std::size_t last) {
            auto& [checker, badNames] = parts[first / kTogether];
            for (std::size_t i = first; i < last; ++i) {
                const std::string& name = *blocks.at(desc_, i).name;
                if (name.empty() || findBadText(name) != std::string_view::npos)
                    badNames.push_back(static_cast<std::uint32_t>(i));
                same.see(i, name);
                blocks.check(checker, desc_, i);
            }
            same.sort(first);
        });
        std::vector<std::uint32_t> bad;
        for (const auto& [checker, badNames] : parts) {
            all_.append(checker);
            bad.insert(bad.end(), badNames.begin(), badNames.end());
        }
        const auto nameAt = [&](std::size_t i) -> std::string_view {
            return *blocks.at(desc_, i).name;
        };
        tellNames(blocks, bad, same.find(nameAt, threads_));
    }

    // In the order of the blocks.
    void tellNames(const Blocks& blocks, std::span<const std::uint32_t> bad,
                   std::span<const SameNames::Pair> same) {
        auto again = same.begin();
        const auto tellSame = [&](std::uint32_t end) {
            for (; again != same.end() && again->second < end; ++again) {
                const AnyBlock block = blocks.at(desc_, again->second);
                const SourceLoc first = blocks.at(desc_, again->first).loc;
                nameError(block, "another ", nameOf(block.type), " has this name", atLine(first));
            }
        };
        for (const std::uint32_t i : bad) {
            tellSame(i);
            nameError(blocks.at(desc_, i),
                      "a name is UTF-8 without control characters, and not empty");
        }
        tellSame(static_cast<std::uint32_t>(blocks.count));
    }
    std::string atLine(SourceLoc loc) const {
        if (loc.offset >= source_.text.size()) return "";
        return cat(" already, at line ", lineOf(source_, loc.offset));
    }

    void checkSettings() {
        const SettingsDesc& s = desc_.settings;
        constexpr long long kLargestArea = 1 << 28; // 3 GiB as float RGB
        if (static_cast<long long>(s.width) * s.height > kLargestArea)
            nameError(s, "'resolution' ", s.width, " ", s.height, " has more than 2^28 pixels");
        if (const std::string fault = faultOfCrop(s); !fault.empty()) nameError(s, fault);
    }

    void warnUnused() {
        const auto tell = [&](const auto& blocks, BlockType target, std::string_view plural) {
            std::vector<std::string> names;
            std::size_t count = 0;
            SourceLoc first;
            for (std::size_t i = 0; i < blocks.size(); ++i) {
                if (used_.has(target, i)) continue;
                if (count++ == 0) first = blocks[i].loc;
                if (names.size() < kListed) names.push_back(shown(blocks[i].name));
            }
            if (count > 0)
                warn(first, cat("nothing uses the ", count == 1 ? nameOf(target) : plural, " ",
                                listed(names, count)));
        };
        tell(desc_.textures, BlockType::Texture, "textures");
        tell(desc_.materials, BlockType::Material, "materials");
        tell(desc_.meshes, BlockType::Mesh, "meshes");
    }

    void warnDark() {
        const Rgbd black{};
        const WorldDesc& world = desc_.world;
        if (world.environment != kNone && world.background == black)
            warn(world.loc, "the environment is multiplied by 'background', which is 0 0 0");
        if (desc_.objects.empty()) return warn({}, "the scene has no objects");
        const auto shines = [&](const LightDesc& light) { return light.color != black; };
        const auto glows = [&](const MaterialDesc& material) {
            return material.emission != black && isUsed(material);
        };
        const bool skyLights = world.environmentLights ||
                               desc_.settings.integrator == SettingsDesc::Integrator::Path;
        if (std::any_of(desc_.lights.begin(), desc_.lights.end(), shines) ||
            std::any_of(desc_.materials.begin(), desc_.materials.end(), glows) ||
            world.ambient != black || (skyLights && world.background != black))
            return;
        warn({}, cat("there is no light, no emission and no ambient: ",
                     world.background == black ? "the picture" : "diffuse surfaces",
                     " will be black; add a light, or 'ambient' to the world"));
    }

    // The most of the light of one colour that comes back from a surface that is seen straight on.
    // Glass and varnish (dielectric) mirror 4 % of it there, so that what is mirrored counts only
    // by itself; what is multiplied by a picture is not known.
    static double mostReturned(const MaterialDesc& m) {
        const auto of = [&](double diffuse, double mirror, double transmission) {
            if (m.diffuseTexture != kNone) diffuse = 0;
            return m.fresnel == MaterialDesc::Fresnel::Dielectric
                       ? std::max(diffuse + transmission, mirror)
                       : diffuse + mirror + transmission;
        };
        return std::max({of(m.diffuse.r, m.mirror.r, m.transmission.r),
                         of(m.diffuse.g, m.mirror.g, m.transmission.g),
                         of(m.diffuse.b, m.mirror.b, m.transmission.b)});
    }

    void warnBright() {
        const auto& materials = desc_.materials;
        const auto isBright = [&](const MaterialDesc& m) {
            return mostReturned(m) > kMostOfWeights && isUsed(m);
        };
        const auto first = std::find_if(materials.begin(), materials.end(), isBright);
        if (first == materials.end()) return;
        warnOfSome(*first, std::count_if(first + 1, materials.end(), isBright),
                   cat("diffuse + mirror + transmission is ", rounded(mostReturned(*first)),
                       "; above 1 a surface gives back more light than it gets"));
    }
    void warnOfWeights() {
        const auto& materials = desc_.materials;
        const auto isMore = [&](const MaterialDesc& m) {
            return !m.lobes.empty() && sumOfWeights(m) > kMostOfWeights && isUsed(m);
        };
        const auto first = std::find_if(materials.begin(), materials.end(), isMore);
        if (first == materials.end()) return;
        warnOfSome(*first, std::count_if(first + 1, materials.end(), isMore),
                   cat("the weights of its lobes sum up to ", rounded(sumOfWeights(*first)),
                       "; they are scaled to 1"));
    }
    // Names one material, and says how many others there are.
    void warnOfSome(const MaterialDesc& first, std::ptrdiff_t others, std::string_view what) {
        warn(first.loc, cat(called(first),
                            others == 0   ? ""
                            : others == 1 ? " and one other"
                                          : cat(" and ", others, " others"),
                            ": ", what));
    }
    static double rounded(double x) { return std::round(x * 1000) / 1000; }
    bool isUsed(const MaterialDesc& material) const {
        return used_.has(BlockType::Material,
                         static_cast<std::size_t>(&material - desc_.materials.data()));
    }

    // Places are doubles, and the renderer makes them floats about the centre of the scene. Far
    // from the origin doubles are 2^-52 of the distance apart; where that is more than a float's
    // rounding of 2^-24 of the scene's extent, the file has lost what the picture could show.
    void warnFar() {
        constexpr double kMost = 0x1p28;
        // No point is farther: how long the box has to be, which most often its first object is.
        const double farthest = 1.01 * all_.largestOfMaps * (3 * all_.reach + 1);
        const BoundsD box = boundsUpTo(desc_, farthest / kMost, threads_);
        if (box.isEmpty()) return;
        const double extent = maxAbs(box.size());
        const double times = std::max(maxAbs(box.lo), maxAbs(box.hi)) / extent;
        if (extent > 0 && times > kMost)
            warn({}, cat("the scene lies more than 10^", std::floor(std::log10(times)),
                         " times its size away from the origin, where numbers are too coarse for "
                         "its details; it would be right about the origin"));
    }

    const SceneDesc& desc_;
    const SourceFile& source_;
    Diagnostics& diagnostics_;
    int threads_;
    UsedBlocks used_;
    std::vector<std::uint32_t> slots_;
    BlockChecker all_{desc_, source_, used_, slots_}; // what all parts found
    ErrorList names_{source_};
};

} // namespace

std::string faultOfCrop(const SettingsDesc& settings) {
    if (!settings.crop) return {};
    const auto [x0, y0, x1, y1] = *settings.crop;
    if (x0 >= x1 || y0 >= y1) return "'crop' is empty; x0 < x1 and y0 < y1 are needed";
    if (x1 <= settings.width && y1 <= settings.height) return {};
    return cat("'crop' ends at ", x1, " ", y1, ", outside the resolution ", settings.width, " ",
               settings.height);
}

bool hasNoArea(const LightDesc& light) {
    using enum LightDesc::Kind;
    const bool isFlat = light.kind == Rectangle || light.kind == Disk;
    return (isFlat && (light.size.x == 0 || light.size.y == 0)) ||
           (light.kind == Sphere && light.radius == 0);
}

void validate(const SceneDesc& desc, const SourceFile& source, Diagnostics& diagnostics,
              int threads) {
    Validator(desc, source, diagnostics, threads).run();
}
