// Seldom: a value that most of its owners leave as it usually is, and that takes no more than a
// pointer there. For large members of things of which there are many.
#pragma once

#include <utility>

template <class T, const T& kUsual> class Seldom {
public:
    Seldom() = default;
    Seldom(const Seldom& other) : own_(other.own_ ? new T(*other.own_) : nullptr) {}
    Seldom(Seldom&& other) noexcept : own_(std::exchange(other.own_, nullptr)) {}
    Seldom& operator=(Seldom other) noexcept {
        std::swap(own_, other.own_);
        return *this;
    }
    Seldom& operator=(const T& value) {
        own() = value;
        return *this;
    }
    ~Seldom() { delete own_; }

    const T& operator*() const { return own_ ? *own_ : kUsual; }
    const T* operator->() const { return &**this; }
    // To be changed: from now on it has a value of its own.
    T& own() {
        if (!own_) own_ = new T(kUsual);
        return *own_;
    }
    bool operator==(const Seldom& other) const { return **this == *other; }

private:
    T* own_ = nullptr;
};
