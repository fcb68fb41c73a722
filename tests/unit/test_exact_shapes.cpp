// Shapes with a formula against their exact counterparts: rows of the battery
// (Code/verify/shapes.cpp, grazing.cpp) at a small size.
#include "check.h"
#include "verify/groups.h"

namespace test_exact_shapes {

TEST(shapes_against_113_bits) {
    for (const auto rows : {battery::shapeRows(), battery::grazingRows()})
        for (const battery::Row& row : rows) {
            const battery::Tally tally = row.run({check::scaled(0.5), 1});
            CHECK_INFO(battery::passed(row, tally),
                       row.id << ' ' << row.what << ": " << tally.failedCase << "; " << tally.worst
                              << ' ' << tally.worstCase);
        }
}

} // namespace test_exact_shapes
