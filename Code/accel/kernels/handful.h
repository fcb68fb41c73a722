// Trees of a few leaves, in which no ray is worth a way of its own: W rays at once against one
// triangle after the other. Of rays that meet nothing hardly more is computed than that.
#pragma once

#include "accel/kernels/kernels.h"
#include "accel/kernels/lane_hits.h"
#include "accel/kernels/queue_exact.h"
#include "accel/kernels/queue_rays.h"
#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/root_boxes.h"
#include "accel/kernels/wide_tree.h"
#include "base/ray.h"
#include "simd/lanes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

LANES_BEGIN

template <Query Q> class Handful {
public:
    static constexpr std::size_t kMostTriangles =
        LaneHits<Q>::kMost; // none has to be settled early
    static bool holds(const WideMesh& mesh) {
        return mesh.tree.nodes == 1 && mesh.triangles.size() <= kMostTriangles;
    }
    // So few that their boxes are not worth a question.
    static constexpr std::size_t kFewTriangles = 4;

    Handful(const WideMesh& mesh, const RaySpan& rays)
        : mesh_(mesh), root_(mesh.tree), asksBoxes_(mesh.triangles.size() > kFewTriangles),
          hits_(mesh, rays) {}

    template <class Results>
    void run(std::span<const std::uint32_t> order, const Results& results) {
        for (std::size_t next = 0; next < order.size(); next += W) {
            const std::size_t count = std::min<std::size_t>(W, order.size() - next);
            const RayColumns columns = hits_.load(&order[next], count);
            const RayAxes axes(columns);
            hits_.start(columns, axes, count);
            const unsigned lanes = axes.traceable & ((1u << count) - 1);
            if (asksBoxes_) {
                const RayLanes slabs(columns, axes, mesh_.extent);
                Floats entry;
                const unsigned near = slabs.entering(root_.whole, hits_.zCut(), entry) & lanes;
                const std::size_t children = near != 0 ? root_.count : 0;
                for (std::size_t i = 0; i < children; ++i)
                    testLeaf(columns, axes, i,
                             slabs.entering(root_[i], hits_.zCut(), entry) & near);
            } else {
                for (std::size_t i = 0; i < root_.count; ++i) testLeaf(columns, axes, i, lanes);
            }
            hits_.finish(columns, axes, results);
        }
    }

private:
    void testLeaf(const RayColumns& columns, const RayAxes& axes, std::size_t child,
                  unsigned lanes) {
        if (lanes == 0) return;
        const WideRef ref = root_.node.child[child];
        const auto& leaf = mesh_.tree.at<WideLeaf<W>>(ref);
        alignas(64) float x[W][W], y[W][W], z[W][W]; // of a point, by ray
        int points = 0;
        for (const auto& corner : leaf.corner)
            for (int j = 0; j < leaf.count; ++j) points = std::max(points, corner[j] + 1);
        const Floats shearX = axes.Sx * axes.sign, shearY = axes.Sy * axes.sign;
        for (int i = 0; i < points; ++i) {
            const Floats relative[3] = {Floats(leaf.point[0][i]) - columns.org[0],
                                        Floats(leaf.point[1][i]) - columns.org[1],
                                        Floats(leaf.point[2][i]) - columns.org[2]};
            const Floats depth = axes.dominant(relative);
            depth.store(z[i]);
            (axes.lateralX(relative) - shearX * depth).store(x[i]);
            (axes.lateralY(relative) - shearY * depth).store(y[i]);
        }
        for (std::uint32_t j = 0; j < leaf.count; ++j) {
            Sheared s;
            for (int c = 0; c < 3; ++c) {
                const std::uint8_t i = leaf.corner[c][j];
                s.x[c] = Floats::load(x[i]), s.y[c] = Floats::load(y[i]);
                s.z[c] = Floats::load(z[i]);
            }
            hits_.ask(columns, axes, s, Edges(s), ref, j, lanes);
        }
    }

    const WideMesh& mesh_;
    const RootBoxes root_;
    const bool asksBoxes_;
    LaneHits<Q> hits_;
};

LANES_END
