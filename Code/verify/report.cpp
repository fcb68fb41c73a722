#include "verify/report.h"

#include "base/text.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace battery {

namespace {

// 12,345,678
std::string grouped(std::uint64_t count) {
    std::string digits = std::to_string(count);
    for (std::size_t at = digits.size(); at > 3;) {
        at -= 3;
        digits.insert(at, 1, ',');
    }
    return digits;
}

std::string shortened(double value) {
    char text[32];
    static_cast<void>(std::snprintf(text, sizeof text, "%.4g", value));
    return text;
}

std::string worstOf(const Row& row, const Tally& tally) {
    std::string out = grouped(tally.failures) + " failed";
    if (*row.unit) out += cat(", ", shortened(tally.worst), " ", row.unit);
    return out;
}
std::string markOf(const Row& row) {
    return *row.unit ? cat("0, ", shortened(row.limit)) : std::string("0");
}

std::string padded(std::string text, std::size_t width) {
    if (text.size() < width) text.resize(width, ' ');
    return text;
}
std::string line(const std::string& id, const std::string& what, const std::string& cases,
                 const std::string& worst, const std::string& mark, const std::string& verdict) {
    const std::size_t room = 15;
    return cat(padded(id, 5), padded(what, 62),
               std::string(room - std::min(room, cases.size()), ' '), cases, "  ",
               padded(worst, 34), padded(mark, 10), verdict, "\n");
}

} // namespace

std::string reportHeading() { return line("test", "what", "cases", "found", "mark", "verdict"); }

std::string reportLine(const Row& row, const Tally& tally, double seconds) {
    char time[32];
    static_cast<void>(std::snprintf(time, sizeof time, " (%.1f s)", seconds));
    std::string out = line(row.id, row.what, grouped(tally.cases), worstOf(row, tally), markOf(row),
                           cat(passed(row, tally) ? "ok"
                               : *row.open        ? "OPEN"
                                                  : "FAILED",
                               time));
    if (passed(row, tally)) return out;
    if (*row.open) out += cat("     not reached yet: ", row.open, "\n");
    if (!tally.failedCase.empty()) out += cat("     failed: ", tally.failedCase, "\n");
    if (!tally.worstCase.empty()) out += cat("     worst: ", tally.worstCase, "\n");
    return out;
}

std::string markdownPage(std::span<const Finding> findings, std::string_view version,
                         double effort) {
    const auto isOk = [](const Finding& f) { return passed(f.row, f.tally); };
    const auto kept = std::count_if(findings.begin(), findings.end(), isOk);
    std::string out = cat(
        "# The stress battery\n\n"
        "What the program promises, as numbers that anybody can make again: `make stress` writes "
        "this page\n(raytracer ",
        version, ", effort ", shortest(effort),
        "), `raytracer verify` runs the quick tests in less than a minute, and `make test`\n"
        "runs all of them at effort 1. The cases are the same on every machine and for any number "
        "of threads. ",
        kept, " of ", findings.size(),
        " tests keep\ntheir marks.\n\n"
        "\"Found\" has the broken rules first, then the largest distance from the truth, which "
        "comes from outside of the\nprogram: closed forms, exact or wider arithmetic, brute "
        "force. \"Mark\" is what may be found. \"Others\" is what was\nmeasured of other "
        "programs with cases of the same kind, where there is something.\n\n"
        "| test | what | cases | found | mark | verdict | others |\n"
        "|---|---|---:|---|---|---|---|\n");
    for (const Finding& f : findings)
        out += cat("| ", f.row.id, " | ", f.row.what, " | ", grouped(f.tally.cases), " | ",
                   worstOf(f.row, f.tally), " | ", markOf(f.row), " | ",
                   isOk(f)       ? std::string("ok")
                   : *f.row.open ? cat("**open**: ", f.row.open)
                                 : std::string("**failed**"),
                   " | ", f.row.peers, " |\n");
    out += "\n## The worst cases\n\n"
           "`raytracer verify TEST --batch N` runs the batch of a case again, alone.\n\n"
           "| test | case |\n|---|---|\n";
    for (const Finding& f : findings)
        for (const auto& [what, text] :
             {std::pair("failed: ", &f.tally.failedCase), std::pair("", &f.tally.worstCase)})
            if (!text->empty()) out += cat("| ", f.row.id, " | ", what, *text, " |\n");
    return out;
}

} // namespace battery
