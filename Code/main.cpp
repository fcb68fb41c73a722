// The program: arguments in, exit code out. The only place that catches and prints errors.
#include "base/error.h"
#include "cli/command.h"

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

int main(int argc, char** argv) {
    Step step;
    try {
        const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
        return static_cast<int>(run(arguments, step));
    } catch (const Error& error) {
        static_cast<void>(std::fprintf(stderr, "%s\n", error.what()));
        return static_cast<int>(error.kind());
    } catch (const std::bad_alloc&) {
        static_cast<void>(std::fprintf(stderr, "raytracer: error: out of memory while %.*s\n",
                                       static_cast<int>(step.name.size()), step.name.data()));
        return static_cast<int>(step.codeOutOfMemory);
    } catch (const std::exception& error) {
        static_cast<void>(std::fprintf(stderr, "raytracer: internal error while %.*s: %s\n",
                                       static_cast<int>(step.name.size()), step.name.data(),
                                       error.what()));
    } catch (...) {
        static_cast<void>(std::fprintf(stderr, "raytracer: internal error\n"));
    }
    return static_cast<int>(ExitCode::Internal);
}
