#include "light/kinds/flat.h"

void setSpread(FlatRow& row, double spreadHalfRad) {
    if (!(spreadHalfRad < kHalfPi * 0.9999)) return;
    const double tangent = exact::tan(spreadHalfRad);
    row.tanSpread = static_cast<float>(tangent);
    row.spreadNorm = static_cast<float>(1 / (tangent - spreadHalfRad));
}
