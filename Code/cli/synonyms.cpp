#include "cli/command.h"

namespace {

// Names of Blender, Cycles, Mitsuba, POV-Ray, pbrt, and of the ray tracers of courses, with a space
// behind each.
struct Synonyms {
    std::string_view ours, theirs;
};
// clang-format off
constexpr Synonyms kSynonyms[] = {
    {"--spp N",
     "--samples --samples-per-pixel --num-samples --nsamples --sample-count --pixel-samples --sample --aa-samples --aasamples --antialiasing --anti-aliasing --antialias --super-sampling --supersampling "},
    {"--spp N, or --error E for a picture as good as that",
     "--quality --noise-threshold --adaptive --min-samples --max-samples "},
    {"--resolution WIDTHxHEIGHT",
     "--width --height --size --res --image-size --dimensions --image-width --image-height --xres --yres -W -H -w "},
    {"--max-depth N",
     "--depth --bounces --max-bounces --ray-depth --max-ray-depth --recursion --recursion-depth --maxdepth --trace-depth --max-recursion "},
    {"--transfer srgb or linear",
     "--gamma --srgb --no-gamma --tonemap --tone-map --color-space --colorspace --view-transform "},
    {"--crop x0,y0,x1,y1",
     "--region --window --cropwindow --crop-window --roi --border --rect "},
    {"--threads N",
     "--jobs --nthreads --num-threads --cores --cpus --workers --num-cores -j "},
    {"--output FILE",
     "--out --outfile --output-file --render-output --image --write --save "},
    {"--light-samples N",
     "--shadow-samples --shadow-rays --soft-shadow-samples "},
    {"--accel bvh or none",
     "--acceleration --accelerator --kdtree --kd-tree --octree "},
    {"--integrator NAME",
     "--render-mode --renderer --mode --engine --algorithm "},
    {"--sampler NAME",
     "--sampling --sampling-method "},
    {"--filter NAME,WIDTH",
     "--pixel-filter --reconstruction-filter --rfilter "},
    {"--exposure EV",
     "--brightness --ev "},
    {"--background r,g,b",
     "--bg --background-color --bgcolor --sky-color "},
    {"--stats",
     "--verbose --statistics --timing --time --profile -V "},
    {"--quiet",
     "--silent --no-progress "},
    {"--info",
     "--list --list-cameras --inspect --dump "},
    {"--check",
     "--dry-run --validate --test --lint "},
    {"--aov NAME,...",
     "--passes --aovs --layers --render-passes "},
    {"--frame N",
     "--frame-number --render-frame --frame-start -f "},
    {"--no-aa",
     "--no-antialiasing --no-anti-aliasing "},
    {"--dof",
     "--depth-of-field --defocus --defocus-blur "},
    {"--no-dof",
     "--no-depth-of-field "},
    {"--reflection",
     "--mirrors "},
    {"--no-reflection",
     "--no-mirrors "},
    {"--refraction",
     "--transparency --transmission "},
    {"--no-refraction",
     "--no-transparency "},
    {"SCENE as the first word",
     "--scene --input --in --file --load "},
};
// clang-format on

} // namespace

std::optional<std::string_view> ourWordsFor(std::string_view theirs) {
    for (const auto& [ours, all] : kSynonyms)
        for (std::size_t at = 0, end; (end = all.find(' ', at)) != std::string_view::npos; at = end + 1)
            if (all.substr(at, end - at) == theirs) return ours;
    return {};
}
