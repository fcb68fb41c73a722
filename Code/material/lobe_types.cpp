#include "material/lobe_types.h"

#include "material/lobes.h"

#include <array>

namespace {

template <class... L> constexpr auto typesOf(kernels::one::LobeList<L...>) {
    return std::array{LobeType{L::kName, L::kFields, L::kFlags}...};
}

} // namespace

std::span<const LobeType> lobeTypes() {
    static constexpr auto types = typesOf(kernels::one::Lobes{});
    return types;
}
