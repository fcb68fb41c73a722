#include "light/light_row.h"

#include "light/lights.h"

#include <algorithm>
#include <bit>

namespace {

template <class L> inline constexpr std::size_t kNumbers = sizeof(typename L::Row) / sizeof(float);

template <class... L> constexpr auto kindsOf(kernels::one::LightList<L...>) {
    static_assert(((kNumbers<L> <= kLightNumbers) && ...));
    return std::array{LightKind{L::kName, kNumbers<L>}...};
}

template <class Row, class... L> constexpr std::uint32_t kindOf(kernels::one::LightList<L...>) {
    std::uint32_t kind = 0, found = sizeof...(L);
    ((std::is_same_v<Row, typename L::Row> ? void(found = kind++) : void(++kind)), ...);
    return found;
}

} // namespace

std::span<const LightKind> lightKinds() {
    static constexpr auto kinds = kindsOf(kernels::one::Lights{});
    return kinds;
}

template <class Row> LightRow lightRow(const Row& row) {
    constexpr std::size_t count = sizeof(Row) / sizeof(float);
    LightRow out{kindOf<Row>(kernels::one::Lights{}), {}};
    std::ranges::copy(std::bit_cast<std::array<float, count>>(row), out.numbers.begin());
    return out;
}

template LightRow lightRow(const PointRow&);
template LightRow lightRow(const SpotRow&);
template LightRow lightRow(const SunRow&);
template LightRow lightRow(const RectangleRow&);
template LightRow lightRow(const DiskRow&);
template LightRow lightRow(const SphereRow&);
template LightRow lightRow(const TriangleRow&);
