// Row T25 of the battery by its name, for FeatureList.txt.
#include "check.h"
#include "verify/groups.h"
#include "verify/report.h"

namespace test_terminator {

TEST(lightEndsSmoothlyOnCoarseMeshes) {
    for (const battery::Row& row : battery::terminatorRows()) {
        const battery::Tally tally = row.run({1, 1});
        CHECK_INFO(battery::passed(row, tally), battery::reportLine(row, tally, 0));
    }
}

} // namespace test_terminator
