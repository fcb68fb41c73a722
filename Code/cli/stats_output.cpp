#include "cli/stats_output.h"

#include "base/text.h"
#include "cli/command.h"
#include "cli/option_setters.h"
#include "cli/skipped_work.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <span>
#include <sstream>

namespace {

std::string fixed(double value, int digits) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(digits) << value;
    return out.str();
}

// 1234567 -> "1 234 567"
std::string grouped(std::uint64_t value) {
    std::string text = std::to_string(value);
    for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, 1, ' ');
    return text;
}

std::string unitOf(const ErrorStats& error) {
    return namesOf<ErrorUnit>()[static_cast<std::size_t>(error.unit)];
}

// "(display; goal 0.01)", what the estimate stands beside.
std::string errorNote(const ErrorStats& error) {
    return cat("(", error.ofWorstBlock ? "worst block, " : "", unitOf(error),
               error.goal ? cat("; goal ", shortest(*error.goal)) : "", ")");
}

double raysPerSecond(const Stats& stats) {
    return stats.renderSeconds > 0 ? static_cast<double>(stats.rays.total()) / stats.renderSeconds
                                   : 0;
}

// What a triangle costs while rendering, its share of points and trees included; 0 without any.
double bytesPerTriangle(const AccelStats& accel) {
    return accel.triangles > 0
               ? static_cast<double>(accel.meshBytes) / static_cast<double>(accel.triangles)
               : 0;
}

std::string quoted(const std::string& text) {
    constexpr char kHex[] = "0123456789abcdef";
    std::string out = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            out += {'\\', c};
        else if (code < 0x20)
            out += std::string("\\u00") + kHex[code >> 4] + kHex[code & 15];
        else
            out += c;
    }
    return out + "\"";
}

// Writes "key": value with commas where they belong.
class JsonObject {
public:
    JsonObject& add(const std::string& key, const std::string& json) {
        if (text_.size() > 1) text_ += ",";
        text_ += quoted(key) + ":" + json;
        return *this;
    }
    JsonObject& add(const std::string& key, double value) {
        return add(key, std::isfinite(value) ? shortest(value) : std::string("null"));
    }
    JsonObject& add(const std::string& key, std::uint64_t value) {
        return add(key, std::to_string(value));
    }
    std::string text() const { return text_ + "}"; }

private:
    std::string text_ = "{";
};

std::string jsonList(std::span<const std::string> words) {
    std::string out = "[";
    for (const std::string& word : words) out += (out.size() > 1 ? "," : "") + quoted(word);
    return out + "]";
}

// Rows of two columns below a heading; numbers are aligned at their right.
class Table {
public:
    void heading(const std::string& text) { out_ << text << "\n"; }
    void row(const std::string& name, const std::string& value, const std::string& unit = "") {
        out_ << "  " << std::left << std::setw(24) << name << std::right << std::setw(16) << value
             << (unit.empty() ? "" : " ") << unit << "\n";
    }
    void line(const std::string& text) { out_ << "  " << text << "\n"; }
    std::string text() const { return out_.str(); }

private:
    std::ostringstream out_;
};

void addFeatures(Table& table, const Stats& stats) {
    table.heading("features");
    table.line("needed   " + (stats.featuresNeeded.empty() ? "none" : join(stats.featuresNeeded)));
    for (std::size_t i = 0; i < stats.featuresSkipped.size(); ++i)
        table.line((i == 0 ? "skipped  " : "         ") + stats.featuresSkipped[i]);
}

// Adds what was skipped, and nothing else: "12 345  rays (30.1 %, about 0.120 s)".
void addSkippedWork(Table& table, const Stats& stats) {
    table.heading("skipped work");
    bool isAny = false;
    for (const SkippedRow& row : skippedWork(stats)) {
        if (row.count == 0) continue;
        const std::string seconds =
            row.seconds ? cat(", about ", fixed(*row.seconds, 3), " s") : "";
        table.row(row.name, grouped(row.count),
                  cat(row.unit, " (", fixed(100 * row.share(), 1), " %", seconds, ")"));
        isAny = true;
    }
    if (!isAny) table.line("none");
}

std::string skippedJson(const Stats& stats) {
    JsonObject all;
    for (const SkippedRow& row : skippedWork(stats)) {
        JsonObject one;
        one.add("count", row.count).add("of", row.of);
        if (row.seconds) one.add("seconds", *row.seconds);
        all.add(row.key, one.text());
    }
    return all.text();
}

} // namespace

std::string mebibytes(std::uint64_t bytes) {
    return fixed(static_cast<double>(bytes) / (1024 * 1024), 1) + " MiB";
}

std::string statsTable(const Stats& s) {
    Table table;
    table.heading("seconds");
    table.row("parse", fixed(s.parseSeconds, 3));
    table.row("build", fixed(s.buildSeconds, 3));
    table.row("render", fixed(s.renderSeconds, 3));
    table.row("write", fixed(s.writeSeconds, 3));
    table.row("total", fixed(s.totalSeconds, 3));
    table.heading("rays");
    table.row("camera", grouped(s.rays.camera));
    table.row("camera hits", grouped(s.cameraHits));
    table.row("shadow", grouped(s.rays.shadow));
    table.row("shadow traced", grouped(s.rays.tracedShadow));
    table.row("reflect", grouped(s.rays.reflect));
    table.row("refract", grouped(s.rays.refract));
    table.row("indirect", grouped(s.rays.indirect));
    table.row("all traced", grouped(s.rays.total()));
    table.row("speed", fixed(raysPerSecond(s) / 1e6, 3), "Mray/s");
    table.heading("accel");
    table.row("kind", s.accel.kind);
    table.row("primitives", grouped(s.accel.primitives));
    table.row("nodes", grouped(s.accel.nodes));
    table.row("leaves", grouped(s.accel.leaves));
    table.row("memory", mebibytes(s.accel.bytes));
    if (s.accel.triangles > 0)
        table.row("meshes", fixed(bytesPerTriangle(s.accel), 1), "bytes per triangle");
    table.row("sah cost", fixed(s.accel.sah, 2));
    table.heading("run");
    table.row("peak memory", s.peakBytes > 0 ? mebibytes(s.peakBytes) : "unknown");
    if (s.mipBytes > 0) table.row("mip levels", mebibytes(s.mipBytes));
    table.row("threads", std::to_string(s.threads));
    table.row("kernel", s.kernel);
    table.row("samples per pixel",
              s.samplesMin == s.samplesMax ? shortest(s.samplesMean) : fixed(s.samplesMean, 1),
              s.samplesMin == s.samplesMax
                  ? ""
                  : cat("(", shortest(s.samplesMin), " to ", shortest(s.samplesMax), ")"));
    if (s.error) {
        table.row("estimated error", significant(s.error->estimate), errorNote(*s.error));
        table.row("passes", std::to_string(s.error->passes));
        table.row("pixels short of goal", grouped(s.error->cappedPixels),
                  cat("(at ", s.error->mostSamples, " samples)"));
        table.row("unsure blocks", grouped(s.error->unsureBlocks),
                  "(one sample is a tenth of their light)");
    }
    if (s.denoisedError)
        table.row("denoised: estimated error", significant(*s.denoisedError),
                  s.error ? cat("(", unitOf(*s.error), ")") : "(RMSE as shown)");
    table.heading("numeric");
    table.row("nan samples", grouped(s.nanSamples));
    table.row("degenerate primitives", grouped(s.degeneratePrimitives));
    addFeatures(table, s);
    addSkippedWork(table, s);
    return table.text();
}

std::string statsJson(const Stats& s, const RunFacts& run) {
    JsonObject seconds, rays, hits, accel, features, samples, numeric, all;
    seconds.add("parse", s.parseSeconds).add("build", s.buildSeconds);
    seconds.add("render", s.renderSeconds).add("write", s.writeSeconds);
    seconds.add("total", s.totalSeconds);
    rays.add("camera", s.rays.camera).add("shadow", s.rays.shadow);
    rays.add("shadow_traced", s.rays.tracedShadow);
    rays.add("reflect", s.rays.reflect).add("refract", s.rays.refract);
    rays.add("indirect", s.rays.indirect);
    hits.add("camera", s.cameraHits);
    accel.add("kind", quoted(s.accel.kind)).add("nodes", s.accel.nodes);
    accel.add("leaves", s.accel.leaves).add("bytes", s.accel.bytes).add("sah", s.accel.sah);
    accel.add("triangles", s.accel.triangles);
    accel.add("bytes_per_triangle", bytesPerTriangle(s.accel));
    features.add("needed", jsonList(s.featuresNeeded)).add("skipped", jsonList(s.featuresSkipped));
    samples.add("min", s.samplesMin).add("mean", s.samplesMean).add("max", s.samplesMax);
    numeric.add("nan_samples", s.nanSamples);
    numeric.add("degenerate_primitives", s.degeneratePrimitives);
    all.add("scene", quoted(run.scene)).add("output", quoted(run.output));
    all.add("width", static_cast<double>(run.size.width));
    all.add("height", static_cast<double>(run.size.height));
    all.add("arguments", jsonList(run.arguments)).add("version", quoted(kVersion));
    all.add("seconds", seconds.text()).add("rays", rays.text()).add("hits", hits.text());
    all.add("rays_per_second", raysPerSecond(s)).add("accel", accel.text());
    all.add("peak_bytes", s.peakBytes).add("mip_bytes", s.mipBytes);
    all.add("threads", static_cast<std::uint64_t>(s.threads));
    all.add("kernel", quoted(s.kernel));
    all.add("features", features.text()).add("skipped_work", skippedJson(s));
    if (s.error) {
        all.add("error_estimate", s.error->estimate);
        all.add("error_unit", quoted(unitOf(*s.error)));
        if (s.error->goal) all.add("error_goal", *s.error->goal);
        all.add("passes", static_cast<std::uint64_t>(s.error->passes));
        all.add("capped_pixels", s.error->cappedPixels);
        all.add("unsure_blocks", s.error->unsureBlocks);
    }
    if (s.denoisedError) all.add("error_estimate_denoised", *s.denoisedError);
    all.add("samples", samples.text()).add("numeric", numeric.text());
    return all.text() + "\n";
}
