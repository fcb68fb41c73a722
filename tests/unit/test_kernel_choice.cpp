// Which kernels there are, and the trees that they walk.
#include "base/error.h"
#include "cli/settings_from.h"
#include "kernel_checks.h"

#include <algorithm>

namespace test_kernel_choice {

using namespace battery;
using namespace kernel_checks;
using meshes::Random;

TEST(kernels_are_chosen_by_name) {
    const auto names = kernelNames();
    CHECK_EQUAL(names.back(), "scalar");
    CHECK_EQUAL(std::string(oneLane().name), "scalar");
    CHECK(bestIsa().supported());
    for (const Isa& kernel : allIsas()) {
        if (kernel.supported())
            CHECK_EQUAL(std::string(chooseKernel(kernel.name).name), kernel.name);
        else
            CHECK_THROWS(chooseKernel(kernel.name), "this CPU can't run");
    }
    CHECK_THROWS(chooseKernel("avx51"), "did you mean 'avx512'");
    CHECK_THROWS(chooseKernel(""), "scalar");
}

TEST(kernels_wide_trees) {
    Random random(74);
    for (const int width : {8, 16}) {
        for (const std::size_t size : {std::size_t{1}, std::size_t{3}, std::size_t{16},
                                       std::size_t{500}, std::size_t{5000}}) {
            const MeshGeometry g = meshes::geometryOf(meshes::soup(random, size), false);
            const WideTree tree = buildWide(width, g.points, g.triangles);
            CHECK_EQUAL(tree.width, width);
            CHECK(tree.leaves * static_cast<std::uint64_t>(width) >= size);
            auto ids = tree.triangleIds; // every triangle once
            std::sort(ids.begin(), ids.end());
            for (std::uint32_t i = 0; i < size; ++i) CHECK(ids[i] == i);
            CHECK_EQUAL(ids.size(), size);
        }
        CHECK(buildWide(width, {}, {}).isEmpty());
        // All in one place: halving ends it.
        std::vector<std::array<Vec3, 3>> same(300, {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}});
        const MeshGeometry g = meshes::geometryOf(same, false);
        CHECK(buildWide(width, g.points, g.triangles).leaves >= 300u / 5);
    }
}

} // namespace test_kernel_choice
