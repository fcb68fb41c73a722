// Seldom: a value that most of its owners leave as it usually is, and that takes no more than a
// pointer there. For large members of things of which there are many.
#pragma once

#include <memory>

template <class T, const T& kUsual> class Seldom {
public:
    Seldom() = default;
    Seldom(const Seldom& other) { *this = other; }
    Seldom(Seldom&&) noexcept = default;
    Seldom& operator=(const Seldom& other) {
        own_ = other.own_ ? std::make_unique<T>(*other.own_) : nullptr;
        return *this;
    }
    Seldom& operator=(Seldom&&) noexcept = default;
    Seldom& operator=(const T& value) {
        own_ = std::make_unique<T>(value);
        return *this;
    }
    ~Seldom() = default;

    const T& operator*() const { return own_ ? *own_ : kUsual; }
    const T* operator->() const { return &**this; }
    // To be changed: from now on it has a value of its own.
    T& own() {
        if (!own_) own_ = std::make_unique<T>(kUsual);
        return *own_;
    }
    bool operator==(const Seldom& other) const { return **this == *other; }

private:
    std::unique_ptr<T> own_;
};
