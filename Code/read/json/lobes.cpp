#include "read/json/materials.h"

#include "base/enum_names.h"
#include "base/text.h"
#include "desc/lobes.h"
#include "desc/names.h"
#include "read/json/properties.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace {

class LobeReader {
public:
    LobeReader(const JsonNames& textures, JsonProblems& problems)
        : textures_(textures), problems_(problems) {}

    // Nothing where it has no type that there is.
    std::optional<LobeDesc> read(const JsonValue& value) {
        JsonFields fields(value, "a lobe", problems_);
        const LobeForm* form = readType(fields, value);
        if (!form) return {};
        lobe_ = form->usual;
        lobe_.loc = value.loc();
        double weight[] = {lobe_.weight.r, lobe_.weight.g, lobe_.weight.b};
        readValue(fields, LobeDesc::Factor::kWeight, kWeightWord, weight, kColor);
        lobe_.weight = {weight[0], weight[1], weight[2]};
        for (std::size_t i = 0; i < form->fields.size(); ++i) {
            const LobeFieldForm& field = form->fields[i];
            readValue(fields, static_cast<std::int8_t>(i), field.name,
                      std::span(lobe_.numbers).subspan(field.first, field.count), field.range);
        }
        fields.read(kCoversWord, lobe_.covers);
        fields.reportUnknown();
        return std::move(lobe_);
    }

private:
    const LobeForm* readType(JsonFields& fields, const JsonValue& value) {
        std::string type;
        const JsonValue* given = fields.read("type", type);
        const auto names = lobeNames();
        const auto found = std::find(names.begin(), names.end(), type);
        if (found != names.end())
            return &lobeForms()[static_cast<std::size_t>(found - names.begin())];
        if (!given && value.isObject())
            problems_.error(value.loc(), [&] {
                return cat("a lobe needs a 'type', such as \"", names.front(), "\"");
            });
        if (given && given->isString())
            problems_.error(given->loc(), [&] { return unknownValue("lobe", shown(type), names); });
        return nullptr;
    }

    void readValue(JsonFields& lobe, std::int8_t field, std::string_view keyword,
                   std::span<double> numbers, const Range& range) {
        const JsonValue* value = lobe.take(keyword);
        if (!value) return;
        if (!value->isObject()) return readNumbers(*value, keyword, numbers, range);
        JsonFields fields(*value, cat("'", keyword, "'"), problems_);
        if (const JsonValue* inner = fields.take("value"))
            readNumbers(*inner, keyword, numbers, range);
        for (const JsonValue& factor : fields.list("factors")) readFactor(factor, field);
        fields.reportUnknown();
    }

    // A colour may be one number, a grey.
    void readNumbers(const JsonValue& value, std::string_view keyword, std::span<double> numbers,
                     const Range& range) {
        if (numbers.size() == 3 && !value.isNumber()) {
            Vec3d rgb;
            if (readJsonValue(value, keyword, problems_, rgb, range))
                numbers[0] = rgb.x, numbers[1] = rgb.y, numbers[2] = rgb.z;
            return;
        }
        double number = 0;
        if (readJsonValue(value, keyword, problems_, number, range))
            std::fill(numbers.begin(), numbers.end(), number);
    }

    void readFactor(const JsonValue& value, std::int8_t field) {
        JsonFields fields(value, "a factor", problems_);
        LobeDesc::Factor factor;
        factor.field = field;
        const auto given = fields.takeOneOf({kTimesWord, kWithoutWord});
        factor.without = given.key == kWithoutWord;
        if (factor.without) fields.read("strength", factor.strength, kFactorStrength);
        if (given.value)
            factor.texture = readJsonTexture(*given.value, given.key, textures_, problems_);
        else if (value.isObject())
            problems_.error(value.loc(), [] {
                return "a factor names a texture, as {\"times\": \"wood\"} or {\"without\": "
                       "\"wood\"}";
            });
        fields.reportUnknown();
        if (factor.texture != kNone) lobe_.factors.push_back(factor);
    }

    const JsonNames& textures_;
    JsonProblems& problems_;
    LobeDesc lobe_;
};

} // namespace

void readJsonLobes(JsonFields& fields, const JsonNames& textures, MaterialDesc& material) {
    for (const JsonValue& value : fields.list("lobes")) {
        if (material.lobes.size() == LobeDesc::kMost)
            return fields.problems().error(value.loc(), [] {
                return cat("a material has at most ", LobeDesc::kMost,
                           " lobes; leave this one out");
            });
        if (auto lobe = LobeReader(textures, fields.problems()).read(value))
            material.lobes.push_back(std::move(*lobe));
    }
    if (!material.lobes.empty() && !fields.has("diffuse")) material.diffuse = {};
}
