// Numbers whose lowest byte comes first, at any address.
// Private to image/.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

template <class Number> Number loadLittle(const std::uint8_t* from) {
    Number number{};
    if constexpr (std::endian::native == std::endian::little)
        std::memcpy(&number, from, sizeof number);
    else
        for (unsigned i = 0; i < sizeof number; ++i)
            number |= static_cast<Number>(static_cast<Number>(from[i]) << (8 * i));
    return number;
}
template <class Number> void storeLittle(std::uint8_t* to, Number number) {
    if constexpr (std::endian::native == std::endian::little)
        std::memcpy(to, &number, sizeof number);
    else
        for (unsigned i = 0; i < sizeof number; ++i)
            to[i] = static_cast<std::uint8_t>(number >> (8 * i));
}
