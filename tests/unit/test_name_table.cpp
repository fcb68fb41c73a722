// Code/desc/name_table.h: whichever way a name is looked up, the first of that name answers.
#include "check.h"

#include "desc/name_table.h"
#include "verify/meshes.h"

#include <string>
#include <vector>

namespace test_name_table {

TEST(names_are_found_from_wherever_the_last_one_was) {
    meshes::Random random(71);
    for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
        std::vector<std::string> names; // some of them twice
        for (std::size_t i = 0; i < count; ++i)
            names.push_back("name" + std::to_string(random.below(count)));
        NameTable table;
        for (std::size_t i = 0; i < count; ++i)
            table.insert(names[i], static_cast<std::uint32_t>(i));
        std::size_t i = 0;
        for (int k = 0; k < 5000; ++k) {
            // Any, and some that nobody has.
            if (count > 0) i = random.below(count);
            const std::string name =
                random.chance(0.1) || count == 0 ? "none" + std::to_string(k % 7) : names[i];
            const auto number = table.find(name);
            CHECK(number.has_value() == (name[1] == 'a'));
            CHECK(!number || names[*number] == name);
        }
    }
}

} // namespace test_name_table
