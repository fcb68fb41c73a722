// A ray that leaves a surface does not meet it again on the side it left to: the rows of the
// battery (Code/verify/leaving.cpp) at a small size.
#include "check.h"
#include "verify/groups.h"

namespace test_reintersection {

TEST(reintersection_of_analytic_shapes) {
    for (const battery::Row& row : battery::leavingRows()) {
        const battery::Tally tally = row.run({check::scaled(0.2), 1});
        CHECK_INFO(battery::passed(row, tally),
                   row.id << ' ' << row.what << ": " << tally.failedCase);
    }
}

} // namespace test_reintersection
