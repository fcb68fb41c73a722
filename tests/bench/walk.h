// How much of a tree a ray visits: what a tree is worth, whatever the machine.
#pragma once

#include "bench/rays.h"

struct BenchWalk {
    double nodes = 0, leaves = 0; // the mean of the rays
};

// Of rays that go alone and to the nearer child first, as few as any single ray can visit: bundles
// share visits, queues look ahead. Of every 16th ray. The mesh must have a tree, or nothing is
// visited.
BenchWalk meanWalk(const MeshGeometry& geometry, const BenchRays& rays);
