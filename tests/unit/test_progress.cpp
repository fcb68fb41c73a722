#include "check.h"

#include "cli/output.h"
#include "cli/progress.h"

namespace test_progress {

namespace {

// A clock and a screen that tests can see.
struct Watched {
    std::string text;
    int writes = 0;
    double now = 100;
    Progress make(Progress::Style style, int columns = 80, double quietSeconds = 0) {
        return Progress(
            style, columns, [this](std::string_view part) { text += part, ++writes; },
            [this] { return now; }, quietSeconds);
    }
};

std::size_t countOf(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
        ++count;
    return count;
}

} // namespace

TEST(progress_clock_text) {
    CHECK_EQUAL(clockText(0), "0:00");
    CHECK_EQUAL(clockText(7.4), "0:07");
    CHECK_EQUAL(clockText(754), "12:34");
    CHECK_EQUAL(clockText(3723), "1:02:03");
    CHECK_EQUAL(clockText(1e30), "99:59:59");
    CHECK_EQUAL(clockText(-1), "0:00");
}

TEST(progress_plain_prints_a_line_per_ten_percent) {
    Watched watched;
    {
        Progress progress = watched.make(Progress::Style::Plain);
        for (int i = 1; i <= 1000; ++i) {
            watched.now += 0.01;
            progress.update(i / 1000.0);
        }
    }
    CHECK_EQUAL(watched.writes, 10);
    CHECK_EQUAL(countOf(watched.text, "\n"), 10u);
    CHECK_EQUAL(countOf(watched.text, "\x1b"), 0u);
    CHECK_EQUAL(countOf(watched.text, "progress 50 %  0:05 elapsed, 0:05 left\n"), 1u);
    CHECK_EQUAL(countOf(watched.text, "progress 100 %  0:10 elapsed\n"), 1u);
}

TEST(progress_plain_skips_steps_of_a_single_jump) {
    Watched watched;
    Progress progress = watched.make(Progress::Style::Plain);
    progress.update(1);
    CHECK_EQUAL(watched.text, "progress 100 %  0:00 elapsed\n");
}

TEST(progress_says_nothing_while_it_is_to_be_quiet) {
    for (const auto style : {Progress::Style::Plain, Progress::Style::Bar}) {
        Watched watched;
        {
            Progress progress = watched.make(style, 80, 1);
            for (int i = 1; i <= 10; ++i) {
                watched.now += 0.09;
                progress.update(i / 11.0);
            }
            CHECK_EQUAL(watched.text, "");
            watched.now += 0.2;
            progress.update(1);
        }
        CHECK(watched.text.ends_with("100 %  0:01 elapsed\n"));
    }
}

TEST(progress_duration_text) {
    CHECK_EQUAL(durationText(0), "0.00 s");
    CHECK_EQUAL(durationText(-1), "0.00 s");
    CHECK_EQUAL(durationText(0.034), "0.03 s");
    CHECK_EQUAL(durationText(9.996), "10.0 s");
    CHECK_EQUAL(durationText(12.56), "12.5 s");
    CHECK_EQUAL(durationText(59.94), "59.9 s");
    CHECK_EQUAL(durationText(60), "1:00");
    CHECK_EQUAL(durationText(3723), "1:02:03");
}

TEST(progress_bar_is_drawn_ten_times_a_second) {
    Watched watched;
    {
        Progress progress = watched.make(Progress::Style::Bar, 60);
        for (int i = 1; i <= 999; ++i) {
            watched.now += 0.001; // all within one second
            progress.update(i / 1000.0);
        }
        CHECK(watched.writes >= 9 && watched.writes <= 11);
        progress.update(1); // the end is always shown
    }
    CHECK(watched.text.ends_with("100 %  0:01 elapsed\n"));
    CHECK_EQUAL(countOf(watched.text, "\n"), 1u);
}

TEST(progress_unfinished_bar_is_taken_off) {
    Watched watched;
    {
        Progress progress = watched.make(Progress::Style::Bar);
        progress.update(0.25);
        CHECK(watched.text.find("[##########..............................]  25 %") !=
              std::string::npos);
    }
    CHECK(watched.text.ends_with("\r\x1b[K"));
}

TEST(progress_bar_fits_into_any_width) {
    for (int columns = 1; columns < 100; ++columns) {
        Watched watched;
        Progress progress = watched.make(Progress::Style::Bar, columns);
        progress.update(0.5);
        const std::size_t escape = 4; // "\r\x1b[K" takes no room
        const std::size_t text = std::string("  50 %  0:00 elapsed, 0:00 left").size();
        CHECK(watched.text.size() - escape <=
              std::max(text, static_cast<std::size_t>(columns) - 1));
    }
}

TEST(progress_none_is_silent) {
    Watched watched;
    {
        Progress progress = watched.make(Progress::Style::None);
        progress.update(0.5);
        progress.update(1);
    }
    CHECK_EQUAL(watched.writes, 0);
}

TEST(preview_keeps_shape_and_colours) {
    Image image(4, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) image.setPixel(x, y, {1, 0, y == 2 ? 1.0f : 0.0f});
    const std::string text = previewText(image, 80, 24);
    CHECK_EQUAL(countOf(text, "\n"), 2u); // three rows of pixels in two of cells
    CHECK_EQUAL(countOf(text, "\xE2\x96\x80"), 8u);
    CHECK_EQUAL(countOf(text, "\x1b[38;2;255;0;0;48;2;255;0;0m"), 4u);
    CHECK_EQUAL(countOf(text, "\x1b[38;2;255;0;255m"), 4u);
    CHECK_EQUAL(countOf(previewText(Image(1000, 500), 80, 24), "\n"), 20u); // 80 x 40 pixels
    CHECK_EQUAL(countOf(previewText(Image(100, 5000), 80, 24), "\n"), 24u);
    CHECK_EQUAL(countOf(previewText(Image(5000, 1), 1, 1), "\n"), 1u);
    const std::string narrow = previewText(Image(1, 5000), 80, 24);
    CHECK_EQUAL(countOf(narrow, "\xE2\x96\x80"), countOf(narrow, "\n")); // one cell in a row
}

} // namespace test_progress
