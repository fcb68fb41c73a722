// What an instruction set does for the program: a table of functions for each family of kernels.
// One is chosen when the program starts and passed by reference; every one of them gives the same
// bits. Each unit of this folder fills one Isa (see families.h).
#pragma once

#include <span>

struct CameraLanes;
struct DenoiseLanes;
struct ShadingKernel;
struct PictureLanes;
struct PlacedKernel;
struct SolidKernel;
struct SurfaceLanes;
struct TriangleKernel;

// A null table: plain code, which every machine has, does the work. Pictures, cameras, shading
// and denoising have no other code than these, and are never null.
struct Isa {
    const char* name;              // as --kernel has it
    int width;                     // lanes of single precision
    bool (*supported)() = nullptr; // whether this CPU has it

    const TriangleKernel* triangles = nullptr; // accel/kernels/kernels.h
    const SolidKernel* solids = nullptr;       // accel/kernels/solids.h
    const PlacedKernel* placed = nullptr;      // accel/kernels/placed.h
    const SurfaceLanes* surfaces = nullptr;    // accel/kernels/surface_lanes.h
    const PictureLanes* pictures = nullptr;    // texture/picture_lanes.h
    const CameraLanes* camera = nullptr;       // camera/camera_lanes.h
    const ShadingKernel* shading = nullptr;    // integrate/shading_kernel.h
    const DenoiseLanes* denoise = nullptr;     // denoise/denoise_lanes.h

    int nodeWidth() const { return width == 16 ? 16 : 8; } // children of a node of its trees
};

// All that this program was built with, the widest first, the one-lane code last.
std::span<const Isa> allIsas();
// The widest that this CPU has.
const Isa& bestIsa();
// The plain code.
const Isa& oneLane();

// The functions of a table; null ones where there is no table.
template <class Table> Table lanesOf(const Table* table) { return table ? *table : Table{}; }
