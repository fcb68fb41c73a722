#include "base/math.h"

#include "base/double_double.h"

double differenceOfProducts(double a, double b, double c, double d) {
    const DoubleDouble ab = twoProduct(a, b), cd = twoProduct(c, d);
    const DoubleDouble hi = twoSum(ab.hi, -cd.hi), lo = twoSum(ab.lo, -cd.lo);
    const DoubleDouble sum = twoSum(hi.hi, lo.hi);
    return sum.hi + (sum.lo + (hi.lo + lo.lo));
}
