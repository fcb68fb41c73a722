// OneOrMore: a vector whose element lies in it as long as it is the only one. For lists that almost
// always have one element and of which there are many: a piece of memory for each would take longer
// than what is done with it.
#pragma once

#include "base/seldom.h"

#include <cstddef>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

template <class T> inline constexpr std::vector<T> kNoMore{};

template <class T> class OneOrMore {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    using value_type = T;

    OneOrMore() = default;
    explicit OneOrMore(std::size_t count, const T& value = T{}) { assign(count, value); }
    OneOrMore(std::initializer_list<T> list)
        : one_(list.size() == 1 ? *list.begin() : T{}), hasOne_(list.size() == 1) {
        if (list.size() > 1) assign(list.begin(), list.end());
    }

    std::size_t size() const { return areMore() ? more_->size() : hasOne_ ? 1 : 0; }
    bool empty() const { return size() == 0; }
    const T* data() const { return areMore() ? more_->data() : &one_; }
    T* data() { return areMore() ? more_.own().data() : &one_; }
    const T* begin() const { return data(); }
    const T* end() const { return data() + size(); }
    T* begin() { return data(); }
    T* end() { return data() + size(); }
    const T& operator[](std::size_t i) const { return data()[i]; }
    T& operator[](std::size_t i) { return data()[i]; }
    const T& at(std::size_t i) const {
        if (i >= size()) throw std::out_of_range("OneOrMore::at");
        return data()[i];
    }
    T& at(std::size_t i) { return const_cast<T&>(std::as_const(*this).at(i)); }
    const T& front() const { return *data(); }
    T& front() { return *data(); }
    const T& back() const { return data()[size() - 1]; }
    T& back() { return data()[size() - 1]; }

    void push_back(T value) {
        if (empty()) {
            one_ = value;
            hasOne_ = true;
            return;
        }
        if (!areMore()) more_.own().push_back(one_);
        more_.own().push_back(value);
    }
    void clear() {
        more_ = decltype(more_)();
        hasOne_ = false;
    }
    void assign(std::size_t count, T value) {
        clear();
        if (count > 1)
            more_.own().assign(count, value);
        else if (count == 1)
            push_back(value);
    }
    // Of elements that are not this list's own.
    template <class Iterator>
    requires(!std::is_integral_v<Iterator>) void assign(Iterator first, Iterator last) {
        clear();
        for (; first != last; ++first) push_back(*first);
    }

    bool operator==(const OneOrMore& other) const { return equals(other); }
    bool operator==(const std::vector<T>& other) const { return equals(other); }

private:
    bool areMore() const { return !more_->empty(); }
    bool equals(std::span<const T> other) const {
        if (size() != other.size()) return false;
        for (std::size_t i = 0; i < other.size(); ++i)
            if (!((*this)[i] == other[i])) return false;
        return true;
    }

    T one_{}; // the only element, if hasOne_ and there are no more
    bool hasOne_ = false;
    Seldom<std::vector<T>, kNoMore<T>> more_; // all elements when there are several
};
