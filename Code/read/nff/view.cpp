#include "read/nff/view.h"

#include "base/text.h"

#include <algorithm>
#include <array>
#include <vector>

namespace {

struct Line {
    std::string_view word;
    bool required;
    std::size_t numbers;
    void (*read)(NffNumbers&, NffView&);
};
// `hither` is "mostly needed for hidden surface algorithms", says the standard: a ray tracer shows
// what is nearer, too.
constexpr auto kLines = std::to_array<Line>({
    {"from", true, 3, [](NffNumbers& n, NffView& view) { view.from = n.point(); }},
    {"at", true, 3, [](NffNumbers& n, NffView& view) { view.at = n.point(); }},
    {"up", true, 3, [](NffNumbers& n, NffView& view) { view.up = n.point(); }},
    {"angle", true, 1,
     [](NffNumbers& n, NffView& view) {
         view.angleDeg = n.number({0, 179.999, true}); // at 180 the picture is infinitely wide
     }},
    {"hither", false, 1, [](NffNumbers& n, NffView&) { n.number(); }},
    {"resolution", true, 2,
     [](NffNumbers& n, NffView& view) {
         view.width = n.whole({1, 65535});
         view.height = n.whole({1, 65535});
     }},
});

const Line* lineOf(const NffWord& word) {
    const auto line = std::find_if(kLines.begin(), kLines.end(),
                                   [&](const Line& l) { return l.word == word.text; });
    return line == kLines.end() ? nullptr : &*line;
}

} // namespace

bool isNffViewLine(const NffWord& word) { return lineOf(word) != nullptr; }

std::optional<NffView> readNffView(NffWords& in, ErrorList& errors, const NffWord& v) {
    NffView view;
    std::array<std::size_t, kLines.size()> given;
    given.fill(NffWords::kNotGiven);
    const std::size_t errorsBefore = errors.count();
    while (const Line* line = lineOf(in.peek())) {
        const NffWord word = in.next();
        in.refuseSecond(word, given[static_cast<std::size_t>(line - kLines.data())]);
        NffNumbers numbers(in, errors, word, line->numbers);
        line->read(numbers, view);
    }
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < kLines.size(); ++i)
        if (kLines[i].required && given[i] == NffWords::kNotGiven)
            missing.push_back(cat("'", kLines[i].word, "'"));
    if (!missing.empty())
        in.failAt(v, cat("the view lacks ", join(missing), "; its lines end before ",
                         described(in.peek())));
    if (view.from == view.at)
        errors.add(v.loc(), [] { return "the view looks 'at' where it is 'from'"; });
    else if (isAlong(view.up, view.at - view.from))
        errors.add(v.loc(), [] { return "'up' is 0 0 0 or the direction of the view itself"; });
    if (errors.count() > errorsBefore) return {};
    return view;
}
