// What Embree does with the mesh and the rays of `bench --write-rays FILE`, in the
// columns of `bench`; make bench-peers builds and runs it.
//   peer_embree FILE [--threads N] [--runs N] [--quality medium|high]
// Each set of rays is traced in every way that Embree offers: one ray per call (single), 8 or 16
// (p8, p16), and with Embree 3 streams of 64 (stream). Shadow rays are traced from the surface to
// the light, and from the light as well (kinds ending in -light). Everything is set as Embree's
// manual advises for speed: flags for coherent and incoherent rays, no robust mode, denormals
// flushed.
#include "embree_calls.h"
#include "peer_input.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <thread>
#include <vector>
#if defined(__SSE3__) || defined(__x86_64__)
#include <pmmintrin.h>
#endif

namespace {

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
