// The list of instruction sets, and the best one for this CPU.
#include "isa/instances.h"

namespace {

bool always() { return true; }

} // namespace

std::span<const Isa> allIsas() {
    static const Isa all[] = {
#if defined(__x86_64__)
        kAvx512Isa,
        kAvx2Isa,
        kSseIsa,
#endif
        {.name = "scalar",
         .width = 1,
         .supported = always,
         .pictures = &kOnePictures,
         .camera = &kOneCamera,
         .shading = &kOneShading,
         .denoise = &kOneDenoise},
    };
    return all;
}

const Isa& bestIsa() {
    for (const Isa& isa : allIsas())
        if (isa.supported()) return isa;
    return oneLane();
}

const Isa& oneLane() { return allIsas().back(); }
