#include "check.h"

#include "base/processor_quota.h"

namespace test_processor_quota {

TEST(processor_quota_of_a_control_group) {
    CHECK_EQUAL(processorsOfQuota("200000 100000"), 2);
    CHECK_EQUAL(processorsOfQuota("150000 100000"), 2); // rounded up
    CHECK_EQUAL(processorsOfQuota("1000 100000"), 1);
    CHECK_EQUAL(processorsOfQuota("1600000 50000"), 32);
    for (const char* none : {"max 100000", "max", "", "-1 100000", "200000", "200000 0", "x y"})
        CHECK_EQUAL(processorsOfQuota(none), 0);
    CHECK_EQUAL(processorsOfQuota("99999999999999999999999 1"), 1'000'000);
}

} // namespace test_processor_quota
