#include "base/processor_quota.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

int processorsOfQuota(std::string_view quota) {
    const auto number = [&] {
        double value = 0;
        const std::size_t start = std::min(quota.find_first_not_of(' '), quota.size());
        quota.remove_prefix(start);
        std::size_t digits = 0;
        for (; digits < quota.size() && quota[digits] >= '0' && quota[digits] <= '9'; ++digits)
            value = 10 * value + (quota[digits] - '0');
        quota.remove_prefix(digits);
        return value;
    };
    const double allowed = number(), period = number();
    if (!(allowed > 0 && period > 0)) return 0;
    return static_cast<int>(std::min(std::ceil(allowed / period), 1e6));
}
