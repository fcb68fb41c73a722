// What the tests of the NFF reader share: a view and a fill for entities to follow, and reading.
#pragma once

#include "base/text.h"
#include "check.h"
#include "read/nff/read_nff.h"

#include <string>
#include <vector>

namespace nff_kit {

inline const std::string kView = "v from 0 -10 0 at 0 0 0 up 0 0 1 angle 90 resolution 11 11\n";
inline const std::string kFill = "f 1 1 1 1 0 100000 0 0\n";

struct Read {
    SceneDesc desc;
    std::vector<std::string> warnings;
};
inline Read readWhole(const std::string& text, const ReadOptions& options = {}) {
    Diagnostics diagnostics;
    const SourceFile source{"t.nff", text};
    Read read{readNff(source, {options, diagnostics}), {}};
    read.warnings = diagnostics.warnings;
    return read;
}
inline SceneDesc readBody(const std::string& body) {
    const Read read = readWhole(kView + body);
    CHECK_INFO(read.warnings.empty(), join(read.warnings));
    return read.desc;
}
inline void checkPoint(Vec3d point, Vec3d expected, double tolerance) {
    CHECK_INFO(maxAbs(point - expected) <= tolerance, point.x << " " << point.y << " " << point.z
                                                              << ", expected " << expected.x << " "
                                                              << expected.y << " " << expected.z);
}

} // namespace nff_kit
