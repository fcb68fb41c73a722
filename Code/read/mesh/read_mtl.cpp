#include "read/mesh/read_mtl.h"

#include "base/math.h"
#include "base/text.h"
#include "desc/names.h"
#include "desc/range.h"
#include "read/mesh/line_reader.h"

#include <algorithm>
#include <optional>
#include <unordered_set>

namespace {

// What has no meaning here, and changes little.
constexpr std::string_view kSilent[] = {"Ka", "map_Ka", "sharpness", "map_aat", "Km"};

// A material as the file says it; what it means depends on statements that come in any order.
struct Written {
    std::string name;
    SourceLoc loc;
    std::optional<Rgbd> Kd, Ks, Ke, Tf;
    std::optional<double> Ns, Ni, d, Tr, Pr;
    int illum = 2;
    Handle mapKd = kNone, mapKs = kNone, mapKe = kNone, mapD = kNone, bump = kNone, norm = kNone;
    double bumpStrength = 1;
};

Rgbd scaled(Rgbd c, double s) { return {c.r * s, c.g * s, c.b * s}; }
bool isBlack(Rgbd c) { return c == Rgbd{}; }

bool contradict(const Written& w) { return w.d && w.Tr && std::fabs(*w.d - (1 - *w.Tr)) > 1e-3; }

MaterialDesc meaningOf(const Written& w) {
    constexpr Rgbd kWhite{1, 1, 1};
    MaterialDesc m;
    m.name = w.name;
    m.loc = w.loc;
    m.diffuse = w.Kd.value_or(w.mapKd == kNone ? m.diffuse : kWhite);
    m.diffuseTexture = w.mapKd;
    const Rgbd shine = w.Ks.value_or(w.mapKs == kNone ? Rgbd{} : kWhite);
    if (w.illum >= 2) {
        m.specular = scaled(shine, kInvPi);
        m.specularTexture = w.mapKs;
    }
    m.exponent = w.Ns.value_or(m.exponent);
    m.ior = w.Ni.value_or(m.ior);
    m.roughness = w.Pr.value_or(0);
    // Programs write Ke 0 0 0 beside a map_Ke that they mean to be seen.
    const Rgbd glow = w.Ke.value_or(Rgbd{});
    m.emission = w.mapKe != kNone && isBlack(glow) ? kWhite : glow;
    m.emissionTexture = w.mapKe;
    m.bumpMap = w.bump;
    m.bumpStrength = w.bumpStrength;
    m.normalMap = w.norm;
    m.opacity = w.d ? *w.d : w.Tr ? 1 - *w.Tr : 1;
    m.opacityTexture = w.mapD;
    m.filter = w.Tf.value_or(kWhite);

    const bool isGlass = w.illum == 4 || w.illum == 6 || w.illum == 7 || w.illum == 9;
    if (isGlass && w.mapD == kNone) {
        const double glass = m.opacity < 1 ? 1 - m.opacity : 1;
        m.diffuse = scaled(m.diffuse, 1 - glass);
        m.transmission = scaled(m.filter, glass);
        m.mirror = scaled(kWhite, glass);
        m.fresnel = MaterialDesc::Fresnel::Dielectric;
        m.filter = kWhite;
        m.opacity = 1;
    } else if (w.illum == 3 || w.illum == 5 || w.illum == 8) {
        m.mirror = shine;
        if (w.illum == 5) m.fresnel = MaterialDesc::Fresnel::Schlick;
    }
    return m;
}

class MtlReader {
public:
    MtlReader(const SourceFile& source, const ReadContext& context)
        : source_(source), context_(context), in_(source) {}

    MtlFile read() {
        while (in_.nextLine()) readStatement();
        endMaterial();
        makeSeen();
        warn();
        file_.textures = std::move(textures_.textures);
        return std::move(file_);
    }

private:
    void readStatement() {
        start_ = in_.offset();
        keyword_ = in_.word();
        if (keyword_ == "newmtl") return beginMaterial();
        if (const std::size_t bad = findBadText(keyword_); bad != std::string_view::npos)
            in_.failAt(start_ + bad, cat("unexpected byte '", shown(keyword_.substr(bad, 1)),
                                         "'; an MTL file is plain text"));
        if (!written_)
            in_.failAt(start_, cat("expected 'newmtl NAME' before '", shown(keyword_), "'"));
        Written& w = *written_;
        using enum TextureDesc::Space;
        if (keyword_ == "Kd") {
            readColour(w.Kd);
        } else if (keyword_ == "Ks") {
            readColour(w.Ks);
        } else if (keyword_ == "Ke") {
            readColour(w.Ke);
        } else if (keyword_ == "Tf") {
            readColour(w.Tf);
        } else if (keyword_ == "Ns") {
            w.Ns = readNumber({0, 1e9});
        } else if (keyword_ == "Ni") {
            readIor(w.Ni);
        } else if (keyword_ == "d") {
            in_.take("-halo");
            w.d = readNumber(kUnit);
        } else if (keyword_ == "Tr") {
            w.Tr = readNumber(kUnit);
        } else if (keyword_ == "Pr") {
            w.Pr = readNumber(kUnit);
        } else if (keyword_ == "illum") {
            readIllum(w.illum);
        } else if (keyword_ == "map_Kd") {
            w.mapKd = readMap(Srgb).texture;
        } else if (keyword_ == "map_Ks") {
            w.mapKs = readMap(Srgb).texture;
        } else if (keyword_ == "map_Ke") {
            w.mapKe = readMap(Srgb).texture;
        } else if (keyword_ == "map_d" || keyword_ == "map_D") {
            w.mapD = readMap(Linear).texture;
        } else if (keyword_ == "map_Bump" || keyword_ == "map_bump" || keyword_ == "bump") {
            const MtlTextures::Map map = readMap(Linear);
            w.bump = map.texture;
            w.bumpStrength = map.bumpStrength.value_or(1);
        } else if (keyword_ == "norm" || keyword_ == "map_Kn" || keyword_ == "map_kn") {
            w.norm = readMap(Linear).texture;
        } else if (std::find(std::begin(kSilent), std::end(kSilent), keyword_) ==
                   std::end(kSilent)) {
            skipped_.add(start_);
        }
    }

    void beginMaterial() {
        endMaterial();
        const std::string_view name = in_.rest();
        if (name.empty()) nameless_.add(start_);
        if (!names_.insert(name).second) again_.add(start_);
        written_.emplace();
        written_->name = name;
        written_->loc = {static_cast<std::uint32_t>(start_)};
    }
    void endMaterial() {
        if (!written_) return;
        if (contradict(*written_)) contradicting_.add(written_->loc.offset);
        const MaterialDesc& m = file_.materials.emplace_back(meaningOf(*written_));
        if (m.opacity == 0 && !written_->d) clear_.add(written_->loc.offset);
    }

    // Some programs write Tr 1 for what is opaque. Where all materials say so, nothing would be
    // seen.
    void makeSeen() {
        if (clear_.count == 0 || clear_.count < file_.materials.size()) {
            clear_.count = 0;
            return;
        }
        for (MaterialDesc& m : file_.materials) m.opacity = 1;
    }

    // r, or r g b. Colours by spectra and in XYZ are of no use without their tables.
    void readColour(std::optional<Rgbd>& colour) {
        if (in_.take("spectral") || in_.take("xyz")) return skipped_.add(start_);
        Rgbd c;
        c.r = c.g = c.b = readValue(kColor);
        if (!in_.atLineEnd()) {
            c.g = readValue(kColor);
            c.b = readValue(kColor);
        }
        expectLineEnd();
        colour = c;
    }
    double readValue(const Range& range) {
        const std::size_t place = (in_.atLineEnd(), in_.offset());
        const double value = in_.number<double>(keyword_, kLargestLength);
        if (!range.contains(value))
            in_.failAt(place,
                       cat("'", keyword_, "' ", mustBe(range, value), ", got ", shortest(value)));
        return value;
    }
    double readNumber(const Range& range) {
        const double value = readValue(range);
        expectLineEnd();
        return value;
    }
    // Programs write 0 for what has no index.
    void readIor(std::optional<double>& ior) {
        const double value = readNumber({0, 1000});
        if (value > 0) ior = value;
    }
    void readIllum(int& illum) {
        const std::size_t place = (in_.atLineEnd(), in_.offset());
        const std::string found = in_.nextWord();
        const auto number = parseInteger(in_.word());
        if (!number || *number < 0)
            in_.failAt(place,
                       cat("expected a whole number from 0 to 10 after 'illum', got ", found));
        expectLineEnd();
        if (*number > 10) return skipped_.add(start_);
        illum = static_cast<int>(*number);
    }
    MtlTextures::Map readMap(TextureDesc::Space space) {
        return textures_.read(in_, keyword_, space);
    }
    void expectLineEnd() {
        if (!in_.atLineEnd())
            in_.failAt(in_.offset(), cat("expected the end of the line after '", keyword_,
                                         "', got ", in_.nextWord()));
    }

    void warn() const {
        const auto tell = [&](const Counted& what, std::string_view one, std::string_view many) {
            if (what.count == 0) return;
            const std::string more =
                what.count == 1 ? "" : cat(" (", what.count, " times, the first here)");
            context_.warn(source_, what.first, cat(what.count == 1 ? one : many, more));
        };
        tell(skipped_, "statement without effect", "statements without effect");
        tell(again_, "this material's name was given already; the first one holds",
             "materials whose names were given already; the first ones hold");
        constexpr std::string_view kClear =
            "all materials have Tr 1 and no d, which would be invisible; they are opaque";
        tell(clear_, kClear, kClear);
        tell(nameless_, "this material has no name", "materials without a name");
        tell(contradicting_, "'d' and 'Tr' contradict each other, Tr is 1 - d; d holds",
             "'d' and 'Tr' contradict each other, Tr is 1 - d; d holds");
    }

    const SourceFile& source_;
    const ReadContext& context_;
    LineReader in_;
    MtlFile file_;
    MtlTextures textures_;
    std::optional<Written> written_; // the material that is being read
    std::unordered_set<std::string_view> names_;
    std::size_t start_ = 0; // of the statement
    std::string_view keyword_;
    Counted skipped_, again_, contradicting_, nameless_, clear_;
};

} // namespace

MtlFile readMtl(const SourceFile& source, const ReadContext& context) {
    return MtlReader(source, context).read();
}
