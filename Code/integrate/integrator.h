// The integrators: what light the samples of a chunk receive, or what else they show.
#pragma once

#include "integrate/wave.h"

#include <cstdint>

// Whitted ray tracing (Whitted 1980) with distributed effects (Cook et al. 1984) over lobes: every
// lamp is asked at every point, and every lobe but diffuse ones is followed. Rough lobes and lamps
// with a size share their light by the power heuristic (Veach 1997).
void integrateWhitted(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                      RayCounts& counts, std::uint64_t& cameraHits);

// Path tracing (Kajiya 1986): each sample follows one path. At each point a lamp is chosen and a
// place on it (next event estimation), and the same light is found by rays that lobes have sampled;
// both are weighted by the power heuristic (Veach 1997).
void integratePath(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                   RayCounts& counts, std::uint64_t& cameraHits);

// Ambient occlusion: the part of the cosine-weighted sky that the first hit sees.
void integrateAo(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                 RayCounts& counts, std::uint64_t& cameraHits);
// normal, depth, albedo, id, uv: shows the first hit.
void integrateFirstHit(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                       RayCounts& counts, std::uint64_t& cameraHits);

// The points of a wave of camera rays, into chunk.first.
void describeFirstHits(const Wave& wave);
// A colour per object number that neighbours in number do not share.
Rgb objectColor(std::uint32_t object);
