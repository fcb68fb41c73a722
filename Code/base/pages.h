// PageVector: a vector for arrays of many megabytes that are written once from front to end. Its
// elements are not zeroed before that, and memory comes in pages of 2 MB where the system has them:
// the first touch of each 4 KB otherwise is half of what building a tree costs. Only where a whole
// one is asked for: the system zeroes all of a page, and where memory is virtual the host may have
// to find it first, which takes up to 5 us for each 4 KB, needed or not.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

inline constexpr std::size_t kLargePage = std::size_t{1} << 21;

template <class T> struct PageAllocator {
    using value_type = T;
    PageAllocator() = default;
    template <class U> PageAllocator(const PageAllocator<U>&) {}

    // Small arrays stay where all others are.
    static bool isLarge(std::size_t bytes) { return bytes >= kLargePage; }

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        if (!isLarge(bytes)) return std::allocator<T>().allocate(count);
        void* const p = ::operator new (bytes, std::align_val_t{kLargePage});
#if defined(__linux__)
        madvise(p, bytes / kLargePage * kLargePage, MADV_HUGEPAGE); // advice: it works without
#endif
        return static_cast<T*>(p);
    }
    void deallocate(T* p, std::size_t count) {
        if (!isLarge(count * sizeof(T))) return std::allocator<T>().deallocate(p, count);
        ::operator delete (p, std::align_val_t{kLargePage});
    }
    // resize(n) leaves new elements of plain types as they are.
    template <class U> void construct(U* p) { ::new (static_cast<void*>(p)) U; }
    template <class U, class... Args> void construct(U* p, Args&&... args) {
        ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
    }
    bool operator==(const PageAllocator&) const = default;
};

template <class T> using PageVector = std::vector<T, PageAllocator<T>>;
