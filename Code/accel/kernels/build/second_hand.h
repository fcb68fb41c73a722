// SecondHand: an array in the memory of another one that nobody reads any more, where that is
// enough. Its pages are there already; the first touch of new ones costs as much as filling them.
#pragma once

#include "base/raw_vector.h"

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>

namespace kernels::build {

template <class Old> class SecondHand {
public:
    explicit SecondHand(RawVector<Old> from) : from_(std::move(from)) {}

    // `fresh` holds the elements if there is no room for them, and must live as long as they.
    template <class T> std::span<T> take(std::size_t count, RawVector<T>& fresh) {
        static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(Old));
        const std::size_t size = (count * sizeof(T) + sizeof(Old) - 1) / sizeof(Old);
        if (size > from_.size() - used_) {
            fresh.resize(count);
            return fresh;
        }
        T* const first = reinterpret_cast<T*>(from_.data() + used_);
        used_ += size;
        std::uninitialized_default_construct_n(first, count);
        return {first, count};
    }

private:
    RawVector<Old> from_;
    std::size_t used_ = 0;
};

} // namespace kernels::build
