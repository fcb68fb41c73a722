// The mesh and the rays of `bench --write-rays FILE`: see tests/bench/file.h.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

[[noreturn]] inline void stop(const std::string& why) {
    std::fprintf(stderr, "peer_embree: %s\n", why.c_str());
    std::exit(1);
}

struct FileRay {
    float org[3], tMin, dir[3], tMax;
};
static_assert(sizeof(FileRay) == 32);

struct RaySet {
    std::string name;
    bool anyHit = false;
    std::vector<FileRay> rays;
};

struct Input {
    std::vector<float> points; // and 4 more: Embree reads 16 bytes at every point
    std::vector<std::uint32_t> corners;
    std::vector<RaySet> sets;
    std::size_t pointCount = 0;
};

inline Input readInput(const std::string& name) {
    std::ifstream file(name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::size_t at = 0;
    const auto take = [&](void* to, std::size_t size) {
        if (bytes.size() - at < size) stop(name + " is no file of bench --write-rays");
        std::memcpy(to, bytes.data() + at, size);
        at += size;
    };
    const auto number = [&] {
        std::uint32_t value = 0;
        take(&value, 4);
        return value;
    };
    char mark[8] = {};
    take(mark, 8);
    if (std::memcmp(mark, "RTRAYS01", 8) != 0) stop(name + " does not begin with RTRAYS01");
    Input input;
    input.pointCount = number();
    input.corners.resize(3 * std::size_t{number()});
    input.sets.resize(number());
    input.points.resize(3 * input.pointCount + 4);
    take(input.points.data(), 12 * input.pointCount);
    take(input.corners.data(), 4 * input.corners.size());
    for (RaySet& set : input.sets) {
        char setName[17] = {};
        take(setName, 16);
        set.name = setName;
        set.rays.resize(number());
        set.anyHit = number() != 0;
        take(set.rays.data(), sizeof(FileRay) * set.rays.size());
    }
    return input;
}

// From the point to the light, a hair short of it, with a direction of length 1.
inline FileRay turned(const FileRay& ray) {
    FileRay back = ray;
    float square = 0;
    for (int i = 0; i < 3; ++i) {
        back.org[i] = ray.org[i] + ray.dir[i] * ray.tMax;
        square += ray.dir[i] * ray.dir[i];
    }
    const float size = std::sqrt(square);
    for (int i = 0; i < 3; ++i) back.dir[i] = -ray.dir[i] / size;
    back.tMax = 0.9999f * size * ray.tMax;
    return back;
}
