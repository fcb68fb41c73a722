// Strided: one member of every element of somebody else's array.
#pragma once

#include <cstddef>

template <class T> class Strided {
public:
    // `first` is the member in the first element, which is `step` bytes before that in the next.
    Strided(T* first, std::size_t step)
        : first_(reinterpret_cast<std::byte*>(first)), step_(step) {}
    T& operator[](std::size_t i) const { return *reinterpret_cast<T*>(first_ + i * step_); }

private:
    std::byte* first_;
    std::size_t step_;
};
