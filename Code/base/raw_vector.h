// RawVector and ZeroedVector: the vectors of large arrays. Their memory is not written before it is
// used, so that each thread is the first to touch what it writes, and comes in large pages where
// there are some: the first touch of each 4 KB otherwise is half of what building a tree costs.
#pragma once

#include "base/platform/platform.h"

#include <cstddef>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

enum class NewElements { AsTheMemoryIs, Zero };

template <class T, NewElements kNew> struct ArrayAllocator {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    using value_type = T;
    template <class U> struct rebind { using other = ArrayAllocator<U, kNew>; };

    ArrayAllocator() = default;
    template <class U> ArrayAllocator(const ArrayAllocator<U, kNew>&) {}

    T* allocate(std::size_t count) {
        void* const memory = kNew == NewElements::Zero
                                 ? std::calloc(count, sizeof(T)) // from the system if it is much
                                 : ::operator new (count * sizeof(T), std::align_val_t{alignof(T)});
        if (!memory) throw std::bad_alloc();
        preferLargePages(memory, count * sizeof(T));
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) noexcept {
        if constexpr (kNew == NewElements::Zero)
            std::free(memory);
        else
            ::operator delete (memory, std::align_val_t{alignof(T)});
    }
    // What resize(n) adds is there already.
    template <class U> void construct(U*) noexcept {}
    template <class U, class... Args> void construct(U* at, Args&&... args) {
        ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
    }
    bool operator==(const ArrayAllocator&) const = default;
};

// New elements are to be written before they are read.
template <class T> using RawVector = std::vector<T, ArrayAllocator<T, NewElements::AsTheMemoryIs>>;
// New elements have zero bits. For vectors that keep their size: what grows again into memory that
// it had finds old values.
template <class T> using ZeroedVector = std::vector<T, ArrayAllocator<T, NewElements::Zero>>;

template <class T> bool operator==(const RawVector<T>& a, const std::vector<T>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < b.size(); ++i)
        if (!(a[i] == b[i])) return false;
    return true;
}
