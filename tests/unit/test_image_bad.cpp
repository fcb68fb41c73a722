// Every broken file in tests/bad/image, and every message of the readers of pictures.
#include "check.h"

#include "base/error.h"
#include "base/file_text.h"
#include "image/image.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace test_image_bad {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> badPictures() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator("tests/bad/image"))
        if (entry.is_regular_file() && entry.path().extension() != ".expect" &&
            entry.path().extension() != ".py")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

// Of the readers that came after PPM, PNG and PFM.
bool isNewer(const fs::path& file) {
    const std::string name = file.filename().string();
    const auto begins = [&](const char* kind) { return name.starts_with(kind); };
    return begins("jpeg") || begins("hdr") || begins("tga") || begins("exr");
}

std::string textOf(const fs::path& file) {
    const auto bytes = readWholeFile(file.string());
    return {bytes.begin(), bytes.end()};
}

// The longest text of each call that fails, as it stands in the code of a reader.
std::vector<std::string> messagesIn(const std::string& code) {
    static const std::regex call(R"((broken\w*|missing|fail|failPicture)\()"), joined("\"\\s+\""),
        literal(R"x("((?:[^"\\]|\\.)*)")x");
    constexpr std::ptrdiff_t kShortest = 10;
    std::vector<std::string> messages;
    for (std::sregex_iterator i(code.begin(), code.end(), call), end; i != end; ++i) {
        const auto from = static_cast<std::size_t>(i->position());
        const std::string text =
            std::regex_replace(code.substr(from, code.find(");", from) - from), joined, "");
        std::string longest;
        for (std::sregex_iterator j(text.begin(), text.end(), literal); j != end; ++j)
            if ((*j)[1].length() > static_cast<std::ptrdiff_t>(longest.size())) longest = (*j)[1];
        if (longest.size() >= kShortest) messages.push_back(longest);
    }
    return messages;
}

} // namespace

TEST(image_bad_files_give_their_messages) {
    int files = 0;
    for (const fs::path& file : badPictures()) {
        std::ifstream side(fs::path(file).replace_extension(".expect"));
        std::string words;
        std::getline(side, words);
        CHECK_INFO(!words.empty(), file.string() << " has no .expect file");
        std::string message;
        ErrorKind kind{};
        try {
            readStoredImage(file.string());
        } catch (const Error& error) {
            message = error.what();
            kind = error.kind();
        }
        CHECK_INFO(message.find(words) != std::string::npos,
                   file.string() << ": '" << message << "' instead of '" << words << "'");
        CHECK_INFO(message.starts_with(file.string() + ":"), message);
        CHECK_INFO(message.find(": error: ") != std::string::npos, message);
        CHECK_INFO(kind == ErrorKind::Input, file.string());
        // What, and what would be right.
        if (isNewer(file)) CHECK_INFO(message.find("; ") != std::string::npos, message);
        ++files;
    }
    CHECK_INFO(files >= 230, files);
}

TEST(image_every_message_has_a_bad_file) {
    std::string said;
    for (const fs::path& file : badPictures())
        said += check::thrown([&] { readStoredImage(file.string()); }) + '\n';
    // The first bytes say which reader a file is for; these are of readers that are given
    // another's.
    const std::vector<std::string> unseen = {"this is no OpenEXR file",
                                             "does not begin with #?RADIANCE",
                                             "does not begin with the bytes FF D8"};
    std::size_t messages = 0;
    for (const auto& entry : fs::directory_iterator("Code/image")) {
        const fs::path& file = entry.path();
        if (!isNewer(file) || file.extension() != ".cpp" || file.stem() == "exr_write") continue;
        for (const std::string& message : messagesIn(textOf(file))) {
            ++messages;
            CHECK_INFO(said.find(message) != std::string::npos ||
                           std::any_of(unseen.begin(), unseen.end(),
                                       [&](const std::string& other) {
                                           return message.find(other) != std::string::npos;
                                       }),
                       file.string() << ": no file in tests/bad/image gives '" << message << "'");
        }
    }
    CHECK_INFO(messages >= 110, messages);
}

} // namespace test_image_bad
