// What Embree does with the mesh and the rays of `raytracer bench --write-rays FILE`, in the
// columns of `raytracer bench`; make bench-peers builds and runs it.
//   peer_embree FILE [--threads N] [--runs N] [--quality medium|high]
// Each set of rays is traced in every way that Embree offers: one ray per call (single), 8 or 16
// (p8, p16), and with Embree 3 streams of 64 (stream). Shadow rays are traced from the surface to
// the light, and from the light as well (kinds ending in -light). Everything is set as Embree's
// manual advises for speed: flags for coherent and incoherent rays, no robust mode, denormals
// flushed.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define PEER_EMBREE4
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <thread>
#include <vector>
#if defined(__SSE3__) || defined(__x86_64__)
#include <pmmintrin.h>
#endif

namespace {

constexpr std::uint32_t kNone = RTC_INVALID_GEOMETRY_ID;

[[noreturn]] void stop(const std::string& why) {
    std::fprintf(stderr, "peer_embree: %s\n", why.c_str());
    std::exit(1);
}

// ---- the file: see Code/cli/bench_file.h

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

Input readInput(const std::string& name) {
    std::ifstream file(name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::size_t at = 0;
    const auto take = [&](void* to, std::size_t size) {
        if (bytes.size() - at < size) stop(name + " is no file of raytracer bench --write-rays");
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
FileRay turned(const FileRay& ray) {
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

// ---- Embree 3 and 4 call alike through these

struct Query {
#ifdef PEER_EMBREE4
    RTCIntersectArguments nearest;
    RTCOccludedArguments any;
    explicit Query(bool coherent) {
        rtcInitIntersectArguments(&nearest);
        rtcInitOccludedArguments(&any);
        nearest.flags = any.flags =
            coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    }
    RTCIntersectArguments* forNearest() { return &nearest; }
    RTCOccludedArguments* forAny() { return &any; }
#define PEER_CALL(function, scene, query, rays) function(scene, rays, query)
#define PEER_PACKET_CALL(function, valid, scene, query, rays) function(valid, scene, rays, query)
#else
    RTCIntersectContext context;
    explicit Query(bool coherent) {
        rtcInitIntersectContext(&context);
        context.flags =
            coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }
    RTCIntersectContext* forNearest() { return &context; }
    RTCIntersectContext* forAny() { return &context; }
#define PEER_CALL(function, scene, query, rays) function(scene, query, rays)
#define PEER_PACKET_CALL(function, valid, scene, query, rays) function(valid, scene, query, rays)
#endif
};

template <int N> struct Packet;
template <> struct Packet<8> {
    using Ray = RTCRay8;
    using RayHit = RTCRayHit8;
    static void nearest(const int* valid, RTCScene scene, Query& query, RayHit* rays) {
        PEER_PACKET_CALL(rtcIntersect8, valid, scene, query.forNearest(), rays);
    }
    static void any(const int* valid, RTCScene scene, Query& query, Ray* rays) {
        PEER_PACKET_CALL(rtcOccluded8, valid, scene, query.forAny(), rays);
    }
};
template <> struct Packet<16> {
    using Ray = RTCRay16;
    using RayHit = RTCRayHit16;
    static void nearest(const int* valid, RTCScene scene, Query& query, RayHit* rays) {
        PEER_PACKET_CALL(rtcIntersect16, valid, scene, query.forNearest(), rays);
    }
    static void any(const int* valid, RTCScene scene, Query& query, Ray* rays) {
        PEER_PACKET_CALL(rtcOccluded16, valid, scene, query.forAny(), rays);
    }
};

RTCRay rayFrom(const FileRay& from) {
    RTCRay ray;
    ray.org_x = from.org[0], ray.org_y = from.org[1], ray.org_z = from.org[2];
    ray.tnear = from.tMin;
    ray.dir_x = from.dir[0], ray.dir_y = from.dir[1], ray.dir_z = from.dir[2];
    ray.time = 0, ray.tfar = from.tMax, ray.mask = ~0u, ray.id = 0, ray.flags = 0;
    return ray;
}
RTCRayHit rayHitFrom(const FileRay& from) {
    RTCRayHit both;
    both.ray = rayFrom(from);
    both.hit.geomID = both.hit.primID = both.hit.instID[0] = kNone;
    return both;
}
template <class Rays> void setLane(Rays& rays, int i, const FileRay& from) {
    rays.org_x[i] = from.org[0], rays.org_y[i] = from.org[1], rays.org_z[i] = from.org[2];
    rays.dir_x[i] = from.dir[0], rays.dir_y[i] = from.dir[1], rays.dir_z[i] = from.dir[2];
    rays.tnear[i] = from.tMin, rays.tfar[i] = from.tMax;
    rays.time[i] = 0, rays.mask[i] = ~0u, rays.id[i] = 0, rays.flags[i] = 0;
}

// ---- measuring

struct Seconds {
    double wall = 0, cpu = 0;
};
template <class Body> Seconds secondsOf(Body&& body) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    body();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
}
double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Answer {
    float t;
    std::uint32_t triangle; // kNone: nothing was hit
};

struct Measurement {
    RTCScene scene;
    int threads, runs;
    std::string who;
    std::vector<Answer> answers = {};

    // body(first, end) for all n rays in parts that are handed out, parts of a multiple of 64.
    template <class Body> void share(std::size_t n, const Body& body) const {
        constexpr std::size_t kPart = 4096;
        std::atomic<std::size_t> next{0};
        const auto work = [&] {
#if defined(__SSE3__) || defined(__x86_64__)
            _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
            _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
            for (std::size_t at; (at = next.fetch_add(kPart)) < n;)
                body(at, std::min(n, at + kPart));
        };
        std::vector<std::thread> others;
        for (int i = 1; i < threads; ++i) others.emplace_back(work);
        work();
        for (std::thread& other : others) other.join();
    }

    // A run that is not timed, and `runs` that are.
    template <class Body> void line(const std::string& kind, const RaySet& set, const Body& body) {
        const std::size_t n = set.rays.size();
        answers.assign(n, {0, kNone});
        share(n, body);
        const double millions = static_cast<double>(n) * 1e-6;
        std::vector<double> wall, cpu;
        for (int run = 0; run < runs; ++run) {
            const Seconds s = secondsOf([&] { share(n, body); });
            wall.push_back(millions / s.wall), cpu.push_back(millions * threads / s.cpu);
        }
        const auto hits = std::count_if(answers.begin(), answers.end(),
                                        [](const Answer& a) { return a.triangle != kNone; });
        std::printf("%s,%s,%s,%zu,%td,%.2f,%.2f,%.2f,%.2f\n", who.c_str(), kind.c_str(),
                    set.name.c_str(), n, hits, medianOf(wall),
                    *std::min_element(wall.begin(), wall.end()),
                    *std::max_element(wall.begin(), wall.end()), medianOf(cpu));
        std::fflush(stdout);
    }

    void single(const std::string& suffix, const RaySet& set, bool coherent) {
        line("single" + suffix, set, [&](std::size_t first, std::size_t end) {
            Query query(coherent);
            for (std::size_t i = first; i < end; ++i) {
                if (set.anyHit) {
                    RTCRay ray = rayFrom(set.rays[i]);
                    PEER_CALL(rtcOccluded1, scene, query.forAny(), &ray);
                    answers[i] = {ray.tfar, ray.tfar < 0 ? 0 : kNone};
                } else {
                    RTCRayHit ray = rayHitFrom(set.rays[i]);
                    PEER_CALL(rtcIntersect1, scene, query.forNearest(), &ray);
                    answers[i] = {ray.ray.tfar, ray.hit.primID};
                }
            }
        });
    }

    // Packets are made beforehand and copied, so that only Embree is measured.
    template <int N> void packets(const std::string& kind, const RaySet& set, bool coherent) {
        using Rays = typename Packet<N>::Ray;
        using RayHits = typename Packet<N>::RayHit;
        const std::size_t count = (set.rays.size() + N - 1) / N;
        std::vector<Rays> rays(set.anyHit ? count : 0);
        std::vector<RayHits> rayHits(set.anyHit ? 0 : count);
        for (std::size_t i = 0; i < count * N; ++i) {
            const FileRay& from = set.rays[std::min(i, set.rays.size() - 1)];
            const int lane = static_cast<int>(i % N);
            if (set.anyHit) {
                setLane(rays[i / N], lane, from);
                continue;
            }
            setLane(rayHits[i / N].ray, lane, from);
            auto& hit = rayHits[i / N].hit;
            hit.geomID[lane] = hit.primID[lane] = hit.instID[0][lane] = kNone;
        }
        alignas(64) int valid[N];
        std::fill_n(valid, N, -1);
        line(kind, set, [&](std::size_t first, std::size_t end) {
            Query query(coherent);
            Answer spare[N];
            for (std::size_t i = first; i < end; i += N) {
                // The last packet is full as well; what it says of the copies is not kept.
                Answer* const to = i + N <= end ? answers.data() + i : spare;
                if (set.anyHit) {
                    Rays mine = rays[i / N];
                    Packet<N>::any(valid, scene, query, &mine);
                    for (int k = 0; k < N; ++k)
                        to[k] = {mine.tfar[k], mine.tfar[k] < 0 ? 0 : kNone};
                } else {
                    RayHits mine = rayHits[i / N];
                    Packet<N>::nearest(valid, scene, query, &mine);
                    for (int k = 0; k < N; ++k) to[k] = {mine.ray.tfar[k], mine.hit.primID[k]};
                }
                if (to == spare) std::copy_n(spare, end - i, answers.data() + i);
            }
        });
    }

#ifndef PEER_EMBREE4 // which has no streams
    void streams(const std::string& suffix, const RaySet& set, bool coherent) {
        line("stream" + suffix, set, [&](std::size_t first, std::size_t end) {
            Query query(coherent);
            constexpr std::size_t kLength = 64;
            alignas(64) RTCRay rays[kLength];
            alignas(64) RTCRayHit rayHits[kLength];
            for (std::size_t i = first; i < end; i += kLength) {
                const std::size_t n = std::min(kLength, end - i);
                const auto count = static_cast<unsigned>(n);
                if (set.anyHit) {
                    for (std::size_t k = 0; k < n; ++k) rays[k] = rayFrom(set.rays[i + k]);
                    rtcOccluded1M(scene, query.forAny(), rays, count, sizeof(RTCRay));
                    for (std::size_t k = 0; k < n; ++k)
                        answers[i + k] = {rays[k].tfar, rays[k].tfar < 0 ? 0 : kNone};
                } else {
                    for (std::size_t k = 0; k < n; ++k) rayHits[k] = rayHitFrom(set.rays[i + k]);
                    rtcIntersect1M(scene, query.forNearest(), rayHits, count, sizeof(RTCRayHit));
                    for (std::size_t k = 0; k < n; ++k)
                        answers[i + k] = {rayHits[k].ray.tfar, rayHits[k].hit.primID};
                }
            }
        });
    }
#endif

    void all(const std::string& suffix, const RaySet& set, bool coherent) {
        single(suffix, set, coherent);
        packets<8>("p8" + suffix, set, coherent);
        packets<16>("p16" + suffix, set, coherent);
#ifndef PEER_EMBREE4
        streams(suffix, set, coherent);
#endif
    }
};

std::atomic<std::ptrdiff_t> allocated{0};
bool countMemory(void*, std::ptrdiff_t bytes, bool) {
    allocated += bytes;
    return true;
}
void stopAtError(void*, RTCError, const char* message) { stop(message); }

// One run that is not timed, and `runs` that are; the last scene stays.
RTCScene build(RTCDevice device, Input& input, RTCBuildQuality quality, int runs,
               const std::string& who) {
    RTCScene scene = nullptr;
    std::vector<double> wall, cpu;
    for (int run = 0; run <= runs; ++run) {
        if (scene != nullptr) rtcReleaseScene(scene);
        allocated = 0;
        scene = rtcNewScene(device);
        RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   input.points.data(), 0, 12, input.pointCount);
        rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   input.corners.data(), 0, 12, input.corners.size() / 3);
        rtcSetGeometryBuildQuality(mesh, quality);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene, mesh);
        rtcReleaseGeometry(mesh);
        rtcSetSceneBuildQuality(scene, quality);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_NONE);
        const Seconds s = secondsOf([&] { rtcCommitScene(scene); });
        if (run > 0) wall.push_back(s.wall * 1e3), cpu.push_back(s.cpu * 1e3);
    }
    std::printf("BUILD,%s,all,%.2f,%.2f,%.2f,%.2f\n", who.c_str(), medianOf(wall),
                *std::min_element(wall.begin(), wall.end()), medianOf(cpu),
                static_cast<double>(allocated) / static_cast<double>(input.corners.size() / 3));
    return scene;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) stop("usage: peer_embree FILE [--threads N] [--runs N] [--quality medium|high]");
    int threads = 1, runs = 5;
    std::string quality = "medium";
    for (int i = 2; i + 1 < argc; i += 2) {
        const std::string flag = argv[i];
        if (flag == "--threads")
            threads = std::max(1, std::atoi(argv[i + 1]));
        else if (flag == "--runs")
            runs = std::max(1, std::atoi(argv[i + 1]));
        else if (flag == "--quality")
            quality = argv[i + 1];
        else
            stop("unknown option " + flag);
    }
    Input input = readInput(argv[1]);
    std::string name = argv[1];
    name = name.substr(name.find_last_of('/') + 1);
    const std::string who =
        name + ",embree-" + RTC_VERSION_STRING + "," + quality + ",fast," + std::to_string(threads);

    const RTCDevice device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
    rtcSetDeviceErrorFunction(device, stopAtError, nullptr);
    rtcSetDeviceMemoryMonitorFunction(device, countMemory, nullptr);
    const RTCBuildQuality howGood =
        quality == "high" ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
    const RTCScene scene = build(device, input, howGood, runs, who);

    Measurement measurement{scene, threads, runs, who};
    for (RaySet& set : input.sets) {
        const bool coherent = set.name == "primary" || set.name == "shadow";
        if (set.name == "shadow") {
            measurement.all("-light", set, coherent);
            for (FileRay& ray : set.rays) ray = turned(ray);
        }
        measurement.all("", set, coherent);
    }
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}
