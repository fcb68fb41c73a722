#include "cli/progress.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double kRedrawSeconds = 0.1;
constexpr int kSteps = 10;
// Back to the first column, and clear to the end of the line (ECMA-48).
constexpr std::string_view kClearLine = "\r\x1b[K";

std::string padded(long long value, std::size_t width, char filler) {
    std::string text = std::to_string(value);
    if (text.size() < width) text.insert(0, width - text.size(), filler);
    return text;
}

// What is left if the rest goes as fast as what is done.
std::string timesText(double part, double elapsed) {
    std::string text = cat(clockText(elapsed), " elapsed");
    if (part > 0 && part < 1) text += cat(", ", clockText(elapsed * (1 - part) / part), " left");
    return text;
}

} // namespace

std::string clockText(double seconds) {
    constexpr double kLongest = 359999; // 99:59:59
    const auto whole = std::llround(std::clamp(seconds, 0.0, kLongest));
    const auto hours = whole / 3600, minutes = whole / 60 % 60;
    const std::string rest = cat(":", padded(whole % 60, 2, '0'));
    if (hours > 0) return cat(hours, ":", padded(minutes, 2, '0'), rest);
    return cat(minutes, rest);
}

std::string durationText(double seconds) {
    if (seconds >= 59.95) return clockText(seconds);
    const int hundredths = static_cast<int>(std::lround(std::max(seconds, 0.0) * 100));
    if (hundredths >= 1000) return cat(hundredths / 100, ".", hundredths / 10 % 10, " s");
    return cat(hundredths / 100, ".", padded(hundredths % 100, 2, '0'), " s");
}

Progress::Progress(Style style, int columns, Write write, Seconds now, double quietSeconds)
    : style_(style), columns_(columns), write_(std::move(write)), now_(std::move(now)),
      start_(now_()), quietSeconds_(quietSeconds) {}

Progress::~Progress() {
    if (onScreen_) write_(kClearLine);
}

void Progress::update(double part) {
    if (style_ == Style::None) return;
    part = std::clamp(part, 0.0, 1.0);
    const double elapsed = now_() - start_;
    if (elapsed < quietSeconds_) return;
    if (style_ == Style::Bar)
        drawBar(part, elapsed);
    else
        printSteps(part, elapsed);
}

void Progress::drawBar(double part, double elapsed) {
    const bool early = lastDrawn_ >= 0 && elapsed - lastDrawn_ < kRedrawSeconds;
    if (early && part < 1) return;
    lastDrawn_ = elapsed;
    const std::string text =
        cat(" ", padded(static_cast<int>(part * 100), 3, ' '), " %  ", timesText(part, elapsed));
    // Two brackets, and the last column stays free: some terminals wrap there.
    constexpr int kLongestBar = 40;
    const int cells = std::min(kLongestBar, columns_ - static_cast<int>(text.size()) - 3);
    std::string bar;
    if (cells > 0) {
        const auto done = static_cast<std::size_t>(part * cells);
        bar = cat("[", std::string(done, '#'),
                  std::string(static_cast<std::size_t>(cells) - done, '.'), "]");
    }
    write_(cat(kClearLine, bar, text, part < 1 ? "" : "\n"));
    onScreen_ = part < 1;
}

void Progress::printSteps(double part, double elapsed) {
    const int reached = static_cast<int>(part * kSteps);
    if (reached < nextStep_) return;
    nextStep_ = reached + 1;
    write_(cat("progress ", reached * 100 / kSteps, " %  ", timesText(part, elapsed), "\n"));
}
