#include "base/seldom.h"
#include "check.h"

#include <array>
#include <utility>

namespace test_seldom {

namespace {

constexpr std::array<int, 3> kUsual = {1, 2, 3};
using Value = Seldom<std::array<int, 3>, kUsual>;
using Three = std::array<int, 3>;

} // namespace

TEST(seldom_is_what_it_usually_is) {
    const Value value;
    CHECK(*value == kUsual);
    CHECK(sizeof(value) == sizeof(void*));
    CHECK(value->at(2) == 3);
}

TEST(seldom_has_a_value_of_its_own) {
    Value value, other;
    value = {4, 5, 6};
    CHECK((*value == Three{4, 5, 6}));
    CHECK(*other == kUsual);
    other = value;
    other.own()[0] = 7; // of the copy alone
    CHECK((*value == Three{4, 5, 6}) && (*other == Three{7, 5, 6}));
    const Value moved = std::move(other);
    CHECK((*moved == Three{7, 5, 6}));
    const Value usual;
    value = usual; // by a copy, too
    CHECK(*value == kUsual);
}

// By what it is, not by where it stands.
TEST(seldom_compares_values) {
    Value value, other;
    value.own();
    CHECK(value == other);
    value.own()[1] = 9;
    CHECK(!(value == other));
    other = {1, 9, 3};
    CHECK(value == other);
}

} // namespace test_seldom
