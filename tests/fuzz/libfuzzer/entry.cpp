// The entry points of libFuzzer: fuzz READER [libFuzzer's flags and folders]; fuzz --list names
// them.
#include "fuzz/targets.h"

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {
const fuzz::Target* target = nullptr;
}

// Takes the reader's name out of the arguments.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    const std::string_view name = *argc > 1 ? (*argv)[1] : "--list";
    target = fuzz::findTarget(name);
    if (!target) {
        for (const fuzz::Target& known : fuzz::targets())
            std::printf("%.*s\n", static_cast<int>(known.name.size()), known.name.data());
        std::exit(name == "--list" ? 0 : 1);
    }
    (*argv)[1] = (*argv)[0];
    ++*argv;
    --*argc;
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    run(*target, {data, size});
    return 0;
}
