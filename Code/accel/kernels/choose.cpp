// The table of kernels, and what the CPU has of it.
#include "accel/kernels/instances.h"

#include "base/cpu.h"
#include "base/error.h"
#include "base/text.h"

#include <array>

namespace {

bool always() { return true; }

constexpr Kernel kTable[] = {
#if defined(__x86_64__)
    {"avx512", 16, hasAvx512, kernels::avx512::closest, kernels::avx512::closestFromPoint,
     kernels::avx512::any, kernels::avx512::anyFromPoint},
    {"avx2", 8, hasAvx2, kernels::avx2::closest, kernels::avx2::closestFromPoint,
     kernels::avx2::any, kernels::avx2::anyFromPoint},
    {"sse", 8, hasSse, kernels::sse::closest, kernels::sse::closestFromPoint, kernels::sse::any,
     kernels::sse::anyFromPoint},
#endif
    {"scalar", 0, always, nullptr, nullptr, nullptr, nullptr},
};

} // namespace

std::span<const Kernel> allKernels() { return kTable; }

std::vector<std::string> kernelNames() {
    std::vector<std::string> names;
    for (const Kernel& kernel : kTable) names.emplace_back(kernel.name);
    return names;
}

const Kernel& chooseKernel(std::string_view name) {
    std::vector<std::string> supported;
    for (const Kernel& kernel : kTable) {
        if (!kernel.supported()) continue;
        if (name == "auto" || name == kernel.name) return kernel;
        supported.emplace_back(kernel.name);
    }
    for (const Kernel& kernel : kTable)
        if (name == kernel.name)
            fail(ErrorKind::Usage, cat("raytracer: error: this CPU can't run the kernel '", name,
                                       "'; it can run: ", join(supported)));
    fail(ErrorKind::Usage, cat("raytracer: error: no kernel ", unknownName(name, kernelNames())));
}
