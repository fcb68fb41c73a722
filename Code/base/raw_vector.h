// RawVector: a PageVector whose new elements are not even constructed, so that each thread is the
// first to touch those that it writes. For plain types; all are to be written before they are read.
#pragma once

#include "base/pages.h"

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

template <class T> struct RawAllocator : PageAllocator<T> {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    RawAllocator() = default;
    template <class U> RawAllocator(const RawAllocator<U>&) {}

    template <class U> void construct(U*) noexcept {}
    template <class U, class... Args> void construct(U* at, Args&&... args) {
        std::construct_at(at, std::forward<Args>(args)...);
    }
};

template <class T> using RawVector = std::vector<T, RawAllocator<T>>;
template <class T> bool operator==(const RawVector<T>& a, const std::vector<T>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
}
