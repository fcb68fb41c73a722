#include "bench/bench.h"

#include "base/file_text.h"
#include "base/parallel.h"
#include "bench/clock.h"
#include "bench/file.h"
#include "bench/picture.h"
#include "bench/trace.h"
#include "bench/walk.h"
#include "cli/command.h"
#include "cli/flag.h"
#include "cli/output.h"
#include "cli/settings_from.h"
#include "desc/validate.h"
#include "read/load.h"
#include "scene/merge.h"

#include <algorithm>
#include <iomanip>

namespace {

// All meshes of the file as the renderer merges them.
struct Subject {
    MeshGeometry geometry;
    SceneFrame frame;
};

Subject subjectOf(const std::string& file) {
    Diagnostics diagnostics;
    const LoadedScene loaded = load(file, diagnostics);
    const SceneFrame frame = frameAround(boundsOf(loaded.desc));
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
    return {std::move(merged.geometry), frame};
}

template <class... Values> std::string numbers(Values... values) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(2);
    ((out << ',' << values), ...);
    return out.str() + "\n";
}

// The measurements of one mesh, a line each, and what all lines begin with.
class Report {
public:
    Report(const BenchOptions& options, const Isa& kernel)
        : options_(options), kernel_(kernel), pool_(options.threads),
          who_(cat(afterLast(options.mesh, "/"), ",raytracer-", kVersion, ",sah,exact,",
                   options.threads, ",", kernel.name)) {}

    // The last tree stays. Each has the memory of the one before it, as have those of peers.
    void build(MeshGeometry& geometry) const {
        std::vector<double> wall, cpu;
        for (int run = 0; run <= options_.runs; ++run) {
            geometry.wide = {};
            const BenchSeconds s =
                secondsOf([&] { geometry.finish(true, kernel_, options_.threads); });
            if (run == 0) continue;
            wall.push_back(s.wall * 1e3), cpu.push_back(s.cpu * 1e3);
        }
        const double bytes = static_cast<double>(geometry.wide.bytes()) /
                             static_cast<double>(geometry.triangles.size());
        writeStdout(cat("BUILD,", who_,
                        numbers(medianOf(wall), *std::min_element(wall.begin(), wall.end()),
                                medianOf(cpu), bytes)));
    }

    void trace(const MeshGeometry& geometry, const BenchRays& rays, bool withUv) {
        BenchTracer tracer(geometry, rays, pool_);
        tracer.trace(withUv);
        const double millions = static_cast<double>(rays.size()) * 1e-6;
        std::vector<double> wall, cpu;
        for (int run = 0; run < options_.runs; ++run) {
            const BenchSeconds s = secondsOf([&] { tracer.trace(withUv); });
            wall.push_back(millions / s.wall), cpu.push_back(millions * options_.threads / s.cpu);
        }
        const BenchWalk walk = meanWalk(geometry, rays);
        writeStdout(cat(who_, withUv ? "+uv," : ",", rays.name, ",", rays.size(), ",",
                        tracer.hitCount(),
                        numbers(medianOf(wall), *std::min_element(wall.begin(), wall.end()),
                                *std::max_element(wall.begin(), wall.end()), medianOf(cpu),
                                walk.nodes, walk.leaves)));
    }

    void picture() const {
        std::vector<double> read, build, render, write, total;
        for (int run = 0; run < options_.runs; ++run) {
            const BenchPicture s = timePicture(options_.mesh, kernel_, options_.threads);
            read.push_back(s.read * 1e3), build.push_back(s.build * 1e3);
            render.push_back(s.render * 1e3), write.push_back(s.write * 1e3);
            total.push_back((s.read + s.build + s.render + s.write) * 1e3);
        }
        writeStdout(cat("PICTURE,", who_, ",", kBenchPictureSide, "x", kBenchPictureSide,
                        numbers(medianOf(read), medianOf(build), medianOf(render), medianOf(write),
                                medianOf(total))));
    }

private:
    const BenchOptions& options_;
    const Isa& kernel_;
    ThreadPool pool_;
    std::string who_;
};

} // namespace

void bench(const BenchOptions& options) {
    const Isa& kernel = chooseKernel(options.kernel);
    auto [geometry, frame] = subjectOf(options.mesh);
    if (!options.raysFile.empty()) {
        checkWritable(options.raysFile);
        geometry.finish(true, kernel, options.threads);
        writeFileAtomically(options.raysFile,
                            encodeBenchFile(geometry, frame, benchRays(geometry, options.view)));
        return;
    }
    Report report(options, kernel);
    report.build(geometry);
    for (const BenchRays& rays : benchRays(geometry, options.view)) {
        report.trace(geometry, rays, false);
        if (options.uv && !rays.anyHit) report.trace(geometry, rays, true);
    }
    if (options.picture) report.picture();
}
