// A fuzzer for g++: damages the files that it is given, keeps what reaches new code, and damages
// that again. Dies, as libFuzzer does, at the first file that a reader does not survive, and leaves
// it under the artifact prefix.
#include "fuzz/plain/arguments.h"
#include "fuzz/plain/coverage.h"
#include "fuzz/plain/mutate.h"
#include "fuzz/targets.h"

#include "base/file_text.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <random>
#include <sanitizer/asan_interface.h>
#include <sanitizer/lsan_interface.h>
#include <stdexcept>

#include <unistd.h>

// In the run-time library of g++, but not in its headers.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*,
                                                                  std::size_t),
                                                         void (*)(const volatile void*));

namespace {

namespace fs = std::filesystem;

// For the handlers of signals and of the sanitizers.
struct {
    std::string bytes;
    std::string artifact;
} current;

std::size_t allocations = 0, releases = 0;

void leaveArtifact() {
    if (std::FILE* file = std::fopen(current.artifact.c_str(), "wb")) {
        std::fwrite(current.bytes.data(), 1, current.bytes.size(), file);
        std::fclose(file);
        std::fprintf(stderr, "Test unit written to %s\n", current.artifact.c_str());
    }
}
// Uncaught exceptions are deaths as well, and so is memory that no small file can need.
extern "C" const char* __asan_default_options() {
    return "handle_abort=1:max_allocation_size_mb=128:hard_rss_limit_mb=1024";
}
extern "C" void onTimeout(int) {
    std::fputs("ERROR: timeout\n", stderr);
    leaveArtifact();
    _exit(70);
}

class Fuzzer {
public:
    explicit Fuzzer(const fuzz::Arguments& arguments)
        : arguments_(arguments), target_(fuzz::findTarget(arguments.reader)) {
        if (!target_) throw std::runtime_error("unknown reader " + arguments.reader);
        if (!arguments.dictionary.empty())
            words_ = fuzz::parseDictionary(contentOf(arguments.dictionary));
        current.artifact = arguments.artifactPrefix + "crash";
        current.bytes.reserve(arguments.maxSize);
    }

    void run() {
        const auto start = std::chrono::steady_clock::now();
        const auto isTimeOver = [&] {
            return arguments_.seconds > 0 && std::chrono::steady_clock::now() - start >=
                                                 std::chrono::seconds(arguments_.seconds);
        };
        for (const std::string& path : arguments_.paths) readPath(path);
        if (files_.empty()) files_.emplace_back();
        std::mt19937 random(arguments_.seed);
        for (std::size_t i = 0; i < arguments_.runs && !isTimeOver(); ++i) {
            // What was found last has led farthest: half of the time it is built on.
            const std::size_t count = files_.size(), recent = std::min<std::size_t>(count, 16);
            const std::size_t from =
                random() % 2 ? random() % count : count - 1 - random() % recent;
            tryFile(fuzz::mutated(files_[from], files_[random() % count], words_,
                                  arguments_.maxSize, random));
        }
        std::printf("#%zu DONE cov: %zu corp: %zu\n", runs_, fuzz::placesCovered(), files_.size());
    }

private:
    static std::string contentOf(const std::string& path) {
        const std::vector<std::uint8_t> bytes = readWholeFile(path);
        return {bytes.begin(), bytes.end()};
    }
    void readPath(const std::string& path) {
        if (!fs::is_directory(path)) return tryFile(contentOf(path));
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(path))
            if (entry.is_regular_file()) names.push_back(entry.path().string());
        std::sort(names.begin(), names.end());
        for (const std::string& name : names) tryFile(contentOf(name));
    }

    void tryFile(std::string file) {
        ++runs_;
        current.bytes.assign(file);
        alarm(static_cast<unsigned>(arguments_.timeout));
        const std::size_t kept = allocations - releases;
        fuzz::startCoverage();
        fuzz::run(*target_, {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()});
        const std::size_t found = fuzz::newCoverage();
        // Tables that are made once stay, too: only the leak check knows.
        if (allocations - releases != kept && __lsan_do_recoverable_leak_check()) {
            leaveArtifact();
            _exit(77);
        }
        alarm(0);
        if (found > 0) files_.push_back(std::move(file));
    }

    const fuzz::Arguments& arguments_;
    const fuzz::Target* target_;
    std::vector<std::string> files_, words_;
    std::size_t runs_ = 0;
};

} // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words == std::vector<std::string>{"--list"}) {
        for (const fuzz::Target& target : fuzz::targets())
            std::printf("%.*s\n", static_cast<int>(target.name.size()), target.name.data());
        return 0;
    }
    fuzz::Arguments arguments;
    try {
        arguments = fuzz::parseArguments(words);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "fuzz: error: %s\n", error.what());
        return 1;
    }
    Fuzzer fuzzer(arguments);
    std::signal(SIGALRM, onTimeout);
    __sanitizer_set_death_callback(leaveArtifact);
    __sanitizer_install_malloc_and_free_hooks(
        [](const volatile void*, std::size_t) { ++allocations; },
        [](const volatile void*) { ++releases; });
    fuzzer.run();
}
