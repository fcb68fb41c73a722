// PageVector: a vector for arrays of many megabytes that are written once from front to end. Its
// elements are not zeroed before that, and memory comes in pages of 2 MB where the system has them:
// the first touch of each 4 KB otherwise is half of what building a tree costs. Only where a whole
// one is asked for: the system zeroes all of a page, and where memory is virtual the host may have
// to find it first, which takes up to 5 us for each 4 KB, needed or not. For the same reason arrays
// of a few pages begin where there is room, best in what others have left, and not with a page.
#pragma once

#include "base/large_pages.h"

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

inline constexpr std::size_t kLargePage = std::size_t{1} << 21;

template <class T> struct PageAllocator {
    using value_type = T;
    PageAllocator() = default;
    template <class U> PageAllocator(const PageAllocator<U>&) {}

    // What the rest of a page costs is little to these.
    static bool beginsAPage(std::size_t bytes) { return bytes >= kWorthATrial; }

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        T* const p = beginsAPage(bytes)
                         ? static_cast<T*>(::operator new (bytes, std::align_val_t{kLargePage}))
                         : std::allocator<T>().allocate(count);
        if (bytes >= kLargePage) tryLargePages(p, bytes);
        return p;
    }
    void deallocate(T* p, std::size_t count) {
        if (!beginsAPage(count * sizeof(T))) return std::allocator<T>().deallocate(p, count);
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
