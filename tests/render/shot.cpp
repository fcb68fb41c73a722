#include "shot.h"

#include "desc/validate.h"
#include "read/txt/read_txt.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <random>

namespace shot {

namespace {

struct Folder {
    std::string path;
    Folder() {
        std::random_device device;
        path = (std::filesystem::temp_directory_path() / cat("raytracer-test-", device())).string();
        std::filesystem::create_directories(path);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
};

} // namespace

const Image& Shot::aov(Aov which) const {
    return std::find_if(aovs.begin(), aovs.end(), [&](const AovImage& a) { return a.aov == which; })
        ->image;
}

SceneDesc parse(const std::string& text) {
    const SourceFile source{"test.txt", "raytracer 1\n" + text};
    SceneDesc desc = readTxt(source);
    Diagnostics diagnostics;
    validate(desc, source, diagnostics);
    return desc;
}

Shot render(const SceneDesc& desc, const Tweak& tweak) {
    RenderSettings settings;
    settings.picture = desc.settings;
    settings.textureFolder = textureFolder();
    if (tweak) tweak(settings);
    const Scene scene(desc, {"test.txt", ""}, settings);
    Shot out;
    Picture picture = ::render(scene, settings, {}, out.stats);
    scene.describe(out.stats);
    out.color = std::move(picture.color);
    out.codes = std::move(picture.codes);
    out.aovs = std::move(picture.aovs);
    return out;
}

Shot render(const std::string& text, const Tweak& tweak) { return render(parse(text), tweak); }

const std::string& textureFolder() {
    static const Folder folder;
    return folder.path;
}

std::string writeTexture(const std::string& name, int width, int height,
                         const std::function<Rgb(double, double)>& value) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.setPixel(x, y, value((x + 0.5) / width, 1 - (y + 0.5) / height));
    image.write(textureFolder() + "/" + name);
    return name;
}

std::string TopView::text() const {
    return cat("settings {\n resolution ", pixels, " ", pixels, "\n samples ", samples,
               samples == 1 ? "\n jitter false" : "", "\n filter box 1\n ", more,
               "\n}\ncamera top {\n type orthographic\n ortho_scale ", shortest(side),
               "\n translate ", shortest(centre.x), " ", shortest(centre.y), " ", shortest(height),
               "\n}\n");
}

Estimate estimate(const Image& image, float Rgb::*channel) {
    const double n = static_cast<double>(image.pixels().size());
    double sum = 0, squares = 0;
    for (const Rgb& pixel : image.pixels()) sum += static_cast<double>(pixel.*channel);
    const double mean = sum / n;
    for (const Rgb& pixel : image.pixels())
        squares += sqr(static_cast<double>(pixel.*channel) - mean);
    return {mean, std::sqrt(squares / (n - 1) / n)};
}

double largest(const Image& image) {
    double out = -kInfinity;
    for (const Rgb& p : image.pixels())
        out = std::max({out, double{p.r}, double{p.g}, double{p.b}});
    return out;
}

double smallest(const Image& image) {
    double out = kInfinity;
    for (const Rgb& p : image.pixels())
        out = std::min({out, double{p.r}, double{p.g}, double{p.b}});
    return out;
}

double maxDifference(const Image& a, const Image& b) {
    double out = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const Rgb d = a.pixels()[i] - b.pixels()[i];
        out =
            std::max({out, std::fabs(double{d.r}), std::fabs(double{d.g}), std::fabs(double{d.b})});
    }
    return out;
}

int differingPixels(const Image& a, const Image& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) count += a.pixels()[i] != b.pixels()[i];
    return count;
}

double length3(Vec3d v) { return std::sqrt(dot(v, v)); }

} // namespace shot
