// Solids: everything with a box of its own that is no triangle, as vector kernels want it. Packets
// of rays walk one wide tree together; shapes with a formula, still or moving, and meshes of a few
// triangles are met in the kernel itself, with the bits of shape/, and any other shape is asked
// where a ray enters its box. Knows nothing about what the shapes are.
#pragma once

#include "accel/kernels/kernels.h"
#include "accel/kernels/wide_tree.h"
#include "accel/solid_form.h"
#include "base/function_ref.h"
#include "base/raw_vector.h"
#include "base/ray.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

struct SolidTree {
    // What the solid is to a kernel.
    enum class Kind : std::uint8_t { Other, Sphere, Facets, Tube, Cube, Disk, Corners, Endless };
    // With which others it may share a test of W rays, each with a solid of its own: shapes of one
    // formula that stand still and whose outside rays of sight meet.
    enum class Meets : std::uint8_t { Sphere, Tube, CappedTube, Cone, CappedCone, Alone };
    // What is looked at first, in one line of the cache.
    struct alignas(64) Solid {
        std::uint32_t number = 0; // what hits and calls name it by
        std::uint32_t part = 0;   // in `facets`, `tubes` or `movements`
        Kind kind = Kind::Other;
        bool hides = true;   // counts when any hit is asked for
        bool isTube = false; // a RoundHull with an axis
        bool turned = false; // the shape's map does more than move and scale along the axes
        bool moves = false;  // as in `movements`
        ::Facets::Side side =
            ::Facets::Side::Both; // of a sphere, a cube, a disk or a plane by corners
        Meets meets = Meets::Alone;
        Vec3 centre{}, axis{};
        float radius = kInfinityF, innerRadius = 0, halfLength = kInfinityF;
        float isOpenFront = 0; // 1: a cylinder without ends whose inside rays of sight don't see
        const StillShape* shape = nullptr; // of all but facets and what is asked ray by ray
    };
    struct Tube {
        StillTube exact;
        // At least the square of how much longer a normal of the wall, or of an end, is in the
        // world.
        double wallStretch = 0, endStretch = 0;
    };
    struct Movement {
        SolidMotion motion;
        Tube tube; // if it is one
    };
    struct Facet {
        std::array<Vec3, 3> corner;
        Vec3d n; // of the plane; any length
    };
    struct FacetGroup {
        std::array<Facet, ::Facets::kMost> facet;
        std::uint32_t count = 0;
        float extent = 0;
        ::Facets::Side side = ::Facets::Side::Both;
    };
    int width = 0;
    RawVector<Solid> solids; // in the order of the tree's leaves
    RawVector<Bounds> boxes; // of the solids
    std::vector<Tube> tubes;
    std::vector<FacetGroup> facets;
    std::vector<Movement> movements;
    std::vector<Solid> endless; // without a box, in no tree: every ray asks them
    // WideNode<width>, root first. A child that isLeaf() is one solid, by its place in `solids`.
    // Rays that enter the box of one of kind Leaf ask it at once, or wait for others. Facets, of
    // which no hull tells which rays pass by, are kInOrder: rays meet them in the order of depth.
    static constexpr auto kInOrder = static_cast<WideKind>(3);
    static constexpr bool isLeaf(WideRef ref) { return (ref & 1) != 0; }
    RawVector<WideTree::Line> lines;
    Bounds around;    // all solids that are in it
    float extent = 0; // see RaySetup
    double sah = 0;   // a ray through `around` meets so many nodes and solids, by their areas

    template <int W> const WideNode<W>& node(WideRef ref) const {
        return *reinterpret_cast<const WideNode<W>*>(
            reinterpret_cast<const std::byte*>(lines.data()) + byteOffset(ref));
    }
    // Room for so many of each common kind: what isn't touched costs nothing, growing would.
    void reserve(std::size_t count);
    void add(const Bounds& box, std::uint32_t number, bool hides, const SolidForm& form);
    void addEndless(std::uint32_t number, bool hides, const SolidForm& form);
    // Once after the last add().
    void build(int nodeWidth, int threads = 1);

    // Or, instead of add() for each of many: what describe(i, next) says of the solid in box i,
    // asked by several threads, once each; `next` comes soon. The same for any number of them.
    struct Described {
        std::uint32_t number = 0;
        bool hides = true;
        SolidForm form;
    };
    using Describe = FunctionRef<Described(std::uint32_t i, std::uint32_t next)>;
    void build(int nodeWidth, std::span<const Bounds> of, const Describe& describe, int threads);

    std::size_t nodes() const { return lines.size() * sizeof(WideTree::Line) / nodeBytes(); }
    std::size_t bytes() const;
    bool isEmpty() const { return solids.empty() && endless.empty(); }

private:
    Solid made(std::uint32_t number, bool hides, const SolidForm& form);
    std::size_t nodeBytes() const {
        return width == 16 ? sizeof(WideNode<16>) : sizeof(WideNode<8>);
    }
    // Returns which box each leaf has.
    std::vector<std::uint32_t> writeNodes(std::span<const Bounds> of, int threads);
    void take(std::span<const std::uint32_t> order, std::span<const Bounds> of,
              const Describe& describe, int threads);
    template <int W> void putFacetsInOrder();
};

// How the kernels ask solids that they do not meet themselves.
struct SolidCalls {
    const void* set = nullptr;
    // Is there a hit nearer than `best`? tEntry: where the ray enters the solid's box. Then it is
    // the new best.
    bool (*nearer)(const void* set, const Ray& ray, std::uint32_t number, float tEntry, Hit& best);
    bool (*hides)(const void* set, const Ray& ray, std::uint32_t number);
};

// One that all rays were asked about.
struct BoxedShape {
    Bounds box;
    float extent; // see RaySetup
    std::uint32_t number;
};

struct SolidKernel {
    // Only rays in `order` are looked at; it pays to have those from one point in a row.
    // hits[i] is the best hit of ray i so far, or what .t allows, and becomes the best of all:
    // the smallest (t, number), t not before the entry into the solid's box.
    void (*closest)(const SolidTree&, const SolidCalls&, const RaySpan&,
                    std::span<const std::uint32_t> order, Hit* hits);
    // hidden[i] becomes 1 where a solid is in (tMin, tMax).
    void (*any)(const SolidTree&, const SolidCalls&, const RaySpan&,
                std::span<const std::uint32_t> order, std::uint8_t* hidden);
    // found[i] is where ray i meets the shape, not before the entry into its box, where it then is;
    // or no hit. Those in front of the best ones so far become the best. Rays of those that are as
    // far go into a list with room for all of them: somebody else decides. Returns how many.
    std::size_t (*nearerInBox)(const BoxedShape& shape, const RaySpan&, Hit* found, Hit* best,
                               std::uint32_t* asFar);
};

// Calls the kernel with the rays of a batch in groups that share their origin.
void closestSolids(const SolidKernel& kernel, const SolidTree& tree, const SolidCalls& calls,
                   const RaySpan& rays, std::span<Hit> hits);
// Leaves rays alone that are hidden already.
void anySolids(const SolidKernel& kernel, const SolidTree& tree, const SolidCalls& calls,
               const RaySpan& rays, std::span<std::uint8_t> hidden);
