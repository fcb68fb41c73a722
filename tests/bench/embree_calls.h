// Embree 3 and 4 call alike through these, and take rays of peer_input.h.
#pragma once

#include "peer_input.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define PEER_EMBREE4
#else
#include <embree3/rtcore.h>
#endif

#include <cstdint>

inline constexpr std::uint32_t kNone = RTC_INVALID_GEOMETRY_ID;

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

inline RTCRay rayFrom(const FileRay& from) {
    RTCRay ray;
    ray.org_x = from.org[0], ray.org_y = from.org[1], ray.org_z = from.org[2];
    ray.tnear = from.tMin;
    ray.dir_x = from.dir[0], ray.dir_y = from.dir[1], ray.dir_z = from.dir[2];
    ray.time = 0, ray.tfar = from.tMax, ray.mask = ~0u, ray.id = 0, ray.flags = 0;
    return ray;
}
inline RTCRayHit rayHitFrom(const FileRay& from) {
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
