#include "cli/choose_kernel.h"

#include "base/error.h"
#include "base/text.h"

std::vector<std::string> kernelNames() {
    std::vector<std::string> names;
    for (const Isa& isa : allIsas()) names.emplace_back(isa.name);
    return names;
}

const Isa& chooseKernel(std::string_view name) {
    if (name == "auto") return bestIsa();
    std::vector<std::string> supported;
    for (const Isa& isa : allIsas()) {
        if (!isa.supported()) continue;
        if (name == isa.name) return isa;
        supported.emplace_back(isa.name);
    }
    for (const Isa& isa : allIsas())
        if (name == isa.name)
            fail(ErrorKind::Usage, cat("raytracer: error: this CPU can't run the kernel '", name,
                                       "'; it can run: ", join(supported)));
    fail(ErrorKind::Usage, cat("raytracer: error: no kernel ", unknownName(name, kernelNames())));
}
