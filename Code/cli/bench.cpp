#include "cli/bench.h"

#include "base/text.h"
#include "cli/bench_rays.h"
#include "cli/output.h"
#include "cli/version.h"
#include "read/load.h"
#include "render/merge.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <iomanip>

namespace {

// All meshes of the file as the renderer merges them.
MeshGeometry geometryOf(const std::string& file) {
    Diagnostics diagnostics;
    const LoadedScene loaded = load(file, diagnostics);
    const SceneFrame frame = frameOf(loaded.desc);
    MergedMesh merged;
    for (const ObjectDesc& object : loaded.desc.objects) {
        if (object.kind != ObjectDesc::Kind::Mesh) continue;
        const MeshDesc& mesh = loaded.desc.meshes[static_cast<std::size_t>(object.mesh)];
        std::uint32_t slots = 1;
        for (const std::uint32_t slot : mesh.triangleMaterials) slots = std::max(slots, slot + 1);
        merged.add(mesh, frame.placed(object.worldFromObject[0]),
                   std::vector<std::uint32_t>(slots, 0), 0);
    }
    if (merged.geometry.triangles.empty()) failUsage(cat(file, " has no triangles"));
    return std::move(merged.geometry);
}

struct Seconds {
    double wall = 0, cpu = 0;
};

template <class Body> Seconds timed(Body&& body) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    body();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// Returns how many rays hit. Of a nearest hit its t and triangle: u and v are computed where they
// are needed, once per picture sample.
std::size_t trace(const MeshGeometry& geometry, const BenchRays& rays) {
    const Mesh scalar(geometry, {0}, {{0, 0}});
    std::vector<TriangleHit> hits;
    std::vector<std::uint8_t> hidden;
    std::size_t count = 0;
    for (std::size_t b = 0; b < rays.batchCount(); ++b) {
        const RaySpan batch = rays.batch(b);
        hits.resize(batch.size()), hidden.resize(batch.size());
        if (geometry.kernel == nullptr) {
            for (std::size_t i = 0; i < batch.size(); ++i) {
                Hit hit;
                count += rays.anyHit ? scalar.occludes(batch[i]) : scalar.intersect(batch[i], hit);
            }
        } else if (rays.anyHit) {
            anyHits(*geometry.kernel, geometry.wideMesh(), batch, hidden);
            for (const std::uint8_t h : hidden) count += h;
        } else {
            closestHits(*geometry.kernel, geometry.wideMesh(), batch, hits);
            for (const TriangleHit& h : hits) count += h.triangle != TriangleHit::kNone;
        }
    }
    return count;
}

} // namespace

std::vector<Flag> benchFlags(BenchOptions& o) {
    const std::string group = "options";
    std::vector<std::string> kernels = kernelNames();
    kernels.insert(kernels.begin(), "auto");
    return {
        {.name = "--kernel",
         .argument = join(kernels, "|"),
         .help = "machine code for the search (auto)",
         .group = group,
         .set = [&o, kernels](const FlagValue& v) { o.kernel = kernels[v.choice(kernels)]; },
         .value = Flag::Value::Required,
         .choices = kernels,
         .example = "scalar"},
        {.name = "--runs",
         .argument = "N",
         .help = "timed runs of each set, behind one that is not timed (5)",
         .group = group,
         .set = [&o](const FlagValue& v) { o.runs = v.whole(1, 1000); },
         .value = Flag::Value::Required,
         .example = "3"},
        {.name = "--help",
         .alias = "-h",
         .help = "this text",
         .group = group,
         .set = [&o](const FlagValue&) { o.help = true; }},
    };
}

BenchOptions parseBenchOptions(std::span<const std::string> arguments) {
    BenchOptions options;
    const std::vector<std::string> names = parseFlags(benchFlags(options), arguments);
    if (options.help) return options;
    if (names.size() != 1) failUsage("bench needs one mesh; usage: raytracer bench MESH [options]");
    options.mesh = names[0];
    return options;
}

ExitCode bench(const BenchOptions& options) {
    const Kernel& kernel = chooseKernel(options.kernel);
    MeshGeometry geometry = geometryOf(options.mesh);
    const std::string name = options.mesh.substr(options.mesh.find_last_of('/') + 1);
    const std::string who = cat(name, ",raytracer-", kVersion, ",sah,exact,1,");
    const auto numbers = [](auto... values) {
        std::ostringstream out;
        out << std::fixed << std::setprecision(2);
        ((out << ',' << values), ...);
        return out.str() + "\n";
    };

    std::vector<double> wall, cpu;
    for (int run = 0; run < options.runs; ++run) {
        MeshGeometry fresh = geometry;
        const Seconds s = timed([&] { fresh.finish(true, kernel); });
        wall.push_back(s.wall * 1e3), cpu.push_back(s.cpu * 1e3);
        if (run + 1 == options.runs) geometry = std::move(fresh);
    }
    const double bytes = static_cast<double>(geometry.wide.bytes() + geometry.bvh.bytes()) /
                         static_cast<double>(geometry.triangles.size());
    writeStdout(cat(
        "BUILD,", who, kernel.name,
        numbers(median(wall), *std::min_element(wall.begin(), wall.end()), median(cpu), bytes)));

    for (const BenchRays& rays : benchRays(geometry)) {
        std::size_t hits = trace(geometry, rays);
        const double millions = static_cast<double>(rays.size()) * 1e-6;
        wall.clear(), cpu.clear();
        for (int run = 0; run < options.runs; ++run) {
            const Seconds s = timed([&] { hits = trace(geometry, rays); });
            wall.push_back(millions / s.wall), cpu.push_back(millions / s.cpu);
        }
        writeStdout(cat(who, kernel.name, ",", rays.name, ",", rays.size(), ",", hits,
                        numbers(median(wall), *std::min_element(wall.begin(), wall.end()),
                                *std::max_element(wall.begin(), wall.end()), median(cpu))));
    }
    return ExitCode::Ok;
}
