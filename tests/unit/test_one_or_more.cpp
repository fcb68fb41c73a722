#include "base/one_or_more.h"
#include "check.h"

#include <random>
#include <utility>
#include <vector>

namespace test_one_or_more {

namespace {

using List = OneOrMore<int>;

// Equal to the vector in all that can be asked.
void checkSame(const List& list, const std::vector<int>& expected, unsigned seed) {
    const bool same =
        list.size() == expected.size() && list.empty() == expected.empty() &&
        std::vector<int>(list.begin(), list.end()) == expected &&
        (expected.empty() || (list.front() == expected.front() && list.back() == expected.back()));
    if (!same)
        check::failed(__FILE__, __LINE__,
                      "a list of " + check::shown(list.size()) + " is not the vector of " +
                          check::shown(expected.size()) + ", seed " + check::shown(seed));
}

} // namespace

// Random steps on a list and on a vector. Sizes 0, 1 and 2 are where it changes its form.
TEST(one_or_more_is_a_vector) {
    for (unsigned seed = 0; seed < check::scaled(2000u); ++seed) {
        std::mt19937 random(seed);
        List list, other;
        std::vector<int> vector, otherVector;
        for (int step = 0; step < 12; ++step) {
            const int value = static_cast<int>(random() % 3);
            const std::size_t count = random() % 4;
            switch (random() % 7) {
            case 0: list.clear(), vector.clear(); break;
            case 1: list.assign(count, value), vector.assign(count, value); break;
            case 2: std::swap(list, other), std::swap(vector, otherVector); break;
            case 3:
                list.assign(otherVector.begin(), otherVector.end());
                vector = otherVector;
                break;
            case 4: other = list, otherVector = vector; break;
            default: list.push_back(value), vector.push_back(value); break;
            }
            checkSame(list, vector, seed);
            checkSame(other, otherVector, seed);
            CHECK((list == other) == (vector == otherVector));
        }
    }
}

TEST(one_or_more_takes_its_own_elements) {
    List list{7};
    for (int i = 0; i < 3; ++i) list.push_back(list.front());
    CHECK((list == List{7, 7, 7, 7}));
    CHECK((List(3, 2) == List{2, 2, 2}));
    CHECK((List(1) == std::vector<int>{0}));
    CHECK(!(List{4} == std::vector<int>{5}));
    CHECK(!(List{4} == std::vector<int>{4, 4}));
    CHECK(List{4}.at(0) == 4);
    CHECK(!check::thrown([] { List{4}.at(1); }).empty());
}

} // namespace test_one_or_more
