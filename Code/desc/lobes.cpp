#include "desc/lobes.h"

#include "base/text.h"
#include "material/lobe_types.h"

#include <algorithm>

static_assert(LobeDesc::kNumbers == kLobeNumbers && LobeDesc::kMost == kMostLobes);

namespace {

// A float of a table as the decimal number that stands there: 0.1, and not 0.100000001.
double asWritten(float value) { return parseDouble(shortest(value)).value_or(0); }

LobeForm formOf(const LobeType& type, std::uint32_t kind) {
    LobeForm form;
    form.name = type.name;
    form.usual.kind = kind;
    form.sendsOn = (type.flags & kSpawnsRays) != 0;
    std::size_t next = 0;
    for (const LobeField& field : type.fields) {
        const auto count = static_cast<std::size_t>(field.count);
        form.fields.push_back(
            {field.name, next, count, {asWritten(field.least), asWritten(field.most)}});
        for (std::size_t i = 0; i < count; ++i)
            form.usual.numbers[next++] = asWritten(field.start[i]);
    }
    return form;
}

} // namespace

std::span<const LobeForm> lobeForms() {
    static const std::vector<LobeForm> forms = [] {
        std::vector<LobeForm> out;
        for (const LobeType& type : lobeTypes())
            out.push_back(formOf(type, static_cast<std::uint32_t>(out.size())));
        return out;
    }();
    return forms;
}

std::span<const std::string_view> lobeNames() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> out;
        for (const LobeForm& form : lobeForms()) out.push_back(form.name);
        return out;
    }();
    return names;
}

double sumOfWeights(const MaterialDesc& material) {
    Rgbd sum;
    double cover = 0;
    for (const LobeDesc& lobe : material.lobes) {
        const auto isOfWeight = [](const LobeDesc::Factor& factor) {
            return factor.field == LobeDesc::Factor::kWeight;
        };
        if (!lobeForms()[lobe.kind].sendsOn ||
            std::any_of(lobe.factors.begin(), lobe.factors.end(), isOfWeight))
            continue;
        if (lobe.covers)
            cover = std::max({cover, lobe.weight.r, lobe.weight.g, lobe.weight.b});
        else
            sum.r += lobe.weight.r, sum.g += lobe.weight.g, sum.b += lobe.weight.b;
    }
    return std::max({sum.r, sum.g, sum.b, cover});
}
