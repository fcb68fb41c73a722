// OBJ lines that are read at once against the same lines read word by word, in every bit and every
// message.
#include "read/mesh/plain_lines.h"

#include "base/text.h"
#include "check.h"
#include "read/mesh/mesh_file.h"
#include "unit/damage.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <string_view>

namespace test_plain_lines {

namespace {

const std::string kAfter = "f 1 2 3\n" + std::string(128, '#'); // what may be read ahead

constexpr ObjCounts kTotal{120, 45, 7};
constexpr std::uint32_t kMissing = MeshBuilder::kMissing;

// The corners of a plain face, "point,uv,normal " each; "no" for what is not.
std::string facesOf(const std::string& line, const std::string& after = kAfter) {
    const std::string text = line + after;
    PlainFace face;
    const char* const next = readPlainFace(text.data(), text.data() + text.size(), kTotal, face);
    if (!next) return "no";
    CHECK_INFO(next == text.data() + line.size(), line);
    const auto shown = [](std::uint32_t index) {
        return index == kMissing ? std::string("-") : cat(index);
    };
    std::string out;
    for (std::size_t i = 0; i < face.count; ++i) {
        const MeshBuilder::Corner& c = face.corners[i];
        out += cat(shown(c.point), ",", shown(c.uv), ",", shown(c.normal), " ");
    }
    return out;
}

// What a file says, or why it says nothing.
struct Outcome {
    MeshFile file;
    std::string message;
};

// The first line of each message, as the second one is that of the text. Without the column where
// that is the end of a line, blanks behind it or not.
std::string messagesOf(const std::string& all, const std::string& text) {
    std::string out;
    for (std::size_t at = 0; (at = all.find("t.obj:", at)) != std::string::npos; ++at) {
        std::string first = all.substr(at, all.find('\n', at) - at);
        char *lineEnd = nullptr, *columnEnd = nullptr; // "t.obj:LINE:COLUMN: ..."
        std::size_t line = std::strtoul(&first[6], &lineEnd, 10);
        const std::size_t column = std::strtoul(lineEnd + 1, &columnEnd, 10);
        std::size_t start = 0;
        for (; line > 1; --line) start = text.find('\n', start) + 1;
        const std::size_t end = std::min(text.find('\n', start), text.size());
        if (text.substr(start, end - start).find_last_not_of(" \t\r") + 2 <= column)
            first.erase(static_cast<std::size_t>(lineEnd - first.data()),
                        static_cast<std::size_t>(columnEnd - lineEnd));
        out += first + "\n";
    }
    return out;
}

Outcome outcomeOf(const std::string& text, int threads) {
    Outcome out;
    Diagnostics diagnostics;
    ReadOptions options;
    options.threads = threads;
    try {
        out.file = readObj({"t.obj", text}, {options, diagnostics});
        out.message = join(diagnostics.warnings, "\n");
    } catch (const Error& error) {
        out.message = error.what();
    }
    out.message = messagesOf(out.message, text);
    return out;
}

// With a blank behind each line: nothing is plain, and all means the same at the same places.
std::string notPlain(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\n') out += ' ';
        out += c;
    }
    return out;
}

bool sameBits(const MeshDesc& a, const MeshDesc& b) {
    const auto equal = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0);
    };
    return equal(a.points, b.points) && equal(a.normals, b.normals) && equal(a.uvs, b.uvs) &&
           equal(a.triangles, b.triangles) && equal(a.normalTriangles, b.normalTriangles) &&
           equal(a.uvTriangles, b.uvTriangles) && equal(a.triangleMaterials, b.triangleMaterials);
}

// Vertices and faces, at times of another kind, in one order or mixed.
class RandomObj {
public:
    explicit RandomObj(std::uint32_t seed) : random_(seed) {}

    std::string text(std::size_t lines) {
        const bool inBlocks = below(2) == 0;
        kind_ = below(4);
        std::string out;
        for (int i = 0; i < 4; ++i) out += cat(vertex("v", 3), vertex("vn", 3), vertex("vt", 2));
        for (std::size_t i = 0; i < lines; ++i) {
            const std::size_t which = inBlocks ? 3 * i / lines : below(3);
            if (which == 0)
                out += vertex("v", 3);
            else if (which == 1)
                out += below(2) == 0 ? vertex("vn", 3) : vertex("vt", 2);
            else
                out += face();
            if (below(2000) == 0) out += "usemtl m" + std::to_string(below(3)) + "\n";
        }
        return out;
    }

private:
    std::size_t below(std::size_t n) { return random_() % n; }

    std::string vertex(const char* keyword, int numbers) {
        ++counts_[keyword[1] == 'n' ? 2 : keyword[1] == 't' ? 1 : 0];
        std::string out = keyword;
        for (int i = 0; i < numbers; ++i) {
            out += below(2) == 0 ? " " : " -";
            out += std::to_string(below(below(2) == 0 ? 10 : 1000));
            if (below(8) != 0) out += "." + std::to_string(random_()).substr(0, 1 + below(9));
            if (below(50) == 0) out += "e-3";
        }
        return out + "\n";
    }
    std::string face() {
        std::string out = "f";
        const std::size_t corners = below(10) == 0 ? 2 + below(4) : 3;
        for (std::size_t i = 0; i < corners; ++i) {
            const auto index = [&](std::size_t which) {
                const std::size_t n = counts_[which];
                return below(100) == 0 ? "-" + std::to_string(1 + below(n))
                                       : std::to_string(1 + below(n));
            };
            out += " " + index(0);
            if (kind_ == 1 || kind_ == 2) out += "/" + index(1);
            if (kind_ == 2) out += "/" + index(2);
            if (kind_ == 3) out += "//" + index(2);
        }
        return out + "\n";
    }

    std::mt19937 random_;
    std::size_t counts_[3] = {};
    std::size_t kind_ = 0;
};

} // namespace

TEST(plain_lines_faces) {
    CHECK_EQUAL(facesOf(" 1 2 120\n"), "0,-,- 1,-,- 119,-,- ");
    CHECK_EQUAL(facesOf(" 7//7 8//6 9//5\r\n"), "6,-,6 7,-,5 8,-,4 ");
    CHECK_EQUAL(facesOf(" 7/1 8/2 9/45 10/4\n"), "6,0,- 7,1,- 8,44,- 9,3,- ");
    CHECK_EQUAL(facesOf(" 7/1/1 8/2/2 0009/3/3\n"), "6,0,0 7,1,1 8,2,2 ");
    for (const char* other : {"\n",
                              " 1 2\n",
                              " 1 2 3 4 5\n",
                              " 1 2 3 \n",
                              "  1 2 3\n",
                              " 1 2 3 #\n",
                              " 1 2 3\\\n",
                              " 1\t2 3\n",
                              " 1 2 0\n",
                              " 1 2 121\n",
                              " 1 2 -1\n",
                              " 1 2 +1\n",
                              " 1 2 12345678\n",
                              " 1/ 2/ 3/\n",
                              " 1// 2// 3//\n",
                              " 1/1/ 2/1/ 3/1/\n",
                              " 1/46 2/1 3/1\n",
                              " 1//8 2//1 3//1\n",
                              " 1/1 2/1 3\n",
                              " 1 2 3/1\n",
                              " 1/1 2//1 3/1\n",
                              " 1 2 a\n",
                              " 1 2 3a\n",
                              " 1 2 3\r4\n"})
        CHECK_INFO(facesOf(other) == "no", other);
    // Whoever comes near the end of the text takes the way word by word.
    CHECK_EQUAL(facesOf(" 1 2 3\n", "v 1 2 3\n"), "no");
}

TEST(plain_lines_words) {
    std::mt19937 random(7);
    for (int i = 0; i < 20000; ++i) {
        std::string line;
        for (std::size_t k = random() % 40; k > 0; --k) line += " \t12/\r-a\xe9"[random() % 9];
        std::size_t words = 0;
        bool isInWord = false;
        for (const char c : line) {
            const bool isBlank = c == ' ' || c == '\t' || c == '\r';
            words += !isBlank && !isInWord;
            isInWord = !isBlank;
        }
        const std::string text = line + "\n" + std::string(8, "a \n"[random() % 3]);
        const CountedWords counted = wordsOfLine(text.data(), text.data() + text.size());
        CHECK_INFO(counted.next == text.data() + line.size() + 1 && counted.words == words,
                   "line " << i << ": '" << line << "' has " << words << ", got " << counted.words);
    }
    const std::string_view open = "1 2 3 4 5 6 7 8 9";
    CHECK(wordsOfLine(open.data(), open.data() + open.size()).next == nullptr);
}

// Floats are as readFloat() has them, also where a double lies half way between two of them.
TEST(plain_lines_floats) {
    std::mt19937_64 random(11);
    std::size_t halfWay = 0;
    for (int i = 0; i < 40000; ++i) {
        // In the middle of two floats: 4 decimals are exact, 14 are not, but one in seven of them
        // has the middle as its double.
        const double k = static_cast<double>(random() % (1 << 23) + (1 << 23)) + 0.5;
        char number[40];
        const int length = i % 2 == 0 ? std::snprintf(number, sizeof number, "%.4f", k * 0x1p-3)
                                      : std::snprintf(number, sizeof number, "%.14f", k * 0x1p-21);
        CHECK(length > 0);
        const std::string text = cat(" ", number, "\n", kAfter);
        std::array<float, 1> value{};
        if (!readPlainNumbers(text.data(), text.data() + text.size(), 1e15, value)) {
            ++halfWay;
            continue;
        }
        const float expected = readFloat(text.data() + 1).value;
        CHECK_INFO(std::bit_cast<std::uint32_t>(value[0]) == std::bit_cast<std::uint32_t>(expected),
                   number);
    }
    CHECK_INFO(halfWay > 1000 && halfWay < 39000, halfWay);
}

// Files of some chunks: plain or not and on any number of threads, they say the same.
TEST(plain_lines_say_what_others_say) {
    std::size_t read = 0;
    for (std::uint32_t seed = 0; seed < check::scaled(12u); ++seed) {
        const std::string text = RandomObj(seed).text(seed % 3 == 0 ? 12000 : 300);
        const Outcome expected = outcomeOf(notPlain(text), 1);
        for (const int threads : {1, 3}) {
            const Outcome found = outcomeOf(text, threads);
            CHECK_INFO(found.message == expected.message,
                       "seed " << seed << ", " << threads << " threads: " << found.message
                               << " instead of " << expected.message);
            CHECK_INFO(sameBits(found.file.mesh, expected.file.mesh),
                       "seed " << seed << ", " << threads << " threads");
        }
        read += !expected.file.mesh.triangles.empty();
    }
    CHECK_INFO(read >= check::scaled(12u) / 2, read);
}

TEST(plain_lines_are_wrong_where_others_are) {
    std::size_t refused = 0;
    const std::string whole = RandomObj(1).text(60);
    const std::vector<std::string> pieces = {"f ",  "v ",   "/",  "-",       "\\\n", "#",
                                             "nan", "0",    "9",  ".",       " ",    "e",
                                             "g",   "\r\n", "\t", "99999999"};
    for (std::uint32_t seed = 0; seed < check::scaled(2000u); ++seed) {
        const std::string text = damage::damaged(whole, pieces, seed);
        const Outcome expected = outcomeOf(notPlain(text), 1), found = outcomeOf(text, 1);
        // A backslash in front of a blank joins no lines.
        if (text.find("\\\n") != std::string::npos || text.find("\\\r") != std::string::npos)
            continue;
        CHECK_INFO(found.message == expected.message,
                   "seed " << seed << ": " << found.message << " instead of " << expected.message);
        CHECK_INFO(sameBits(found.file.mesh, expected.file.mesh), "seed " << seed);
        refused += found.message.find("error") != std::string::npos;
    }
    CHECK_INFO(refused > check::scaled(200u), refused);
}

} // namespace test_plain_lines
