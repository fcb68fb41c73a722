// ZeroedVector: a vector whose elements start as zero bits without being written: the memory comes
// that way from the system, and belongs to the thread that touches it first.
#pragma once

#include "base/large_pages.h"

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

template <class T> struct ZeroedAllocator {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    using value_type = T;

    ZeroedAllocator() = default;
    template <class U> explicit ZeroedAllocator(const ZeroedAllocator<U>&) {}

    T* allocate(std::size_t count) {
        if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
        void* memory = zeroedMemory(count * sizeof(T));
        if (!memory) throw std::bad_alloc();
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) noexcept {
        freeZeroedMemory(memory, count * sizeof(T));
    }

    // Of a vector's new elements; the zeros are there.
    template <class U> void construct(U*) noexcept {}
    template <class U, class... Args> void construct(U* at, Args&&... args) {
        std::construct_at(at, std::forward<Args>(args)...);
    }
    bool operator==(const ZeroedAllocator&) const { return true; }
};

// For vectors that keep their size: what grows again into memory that it had finds old values.
template <class T> using ZeroedVector = std::vector<T, ZeroedAllocator<T>>;
