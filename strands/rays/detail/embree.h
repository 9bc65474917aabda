#pragma once
// Embree 3.13 or 4, whichever the build found, behind the few names that differ; for the sources of strands/rays alone.
#ifdef CUTICLE_EMBREE4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace cuticle::strands {

#ifdef CUTICLE_EMBREE4
using RayContext = RTCRayQueryContext;

inline void trace_closest(RTCScene scene, RayContext& context, RTCRayHit& ray) {
  rtcInitRayQueryContext(&context);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}
inline void trace_any(RTCScene scene, RayContext& context, RTCRay& ray) {
  rtcInitRayQueryContext(&context);
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}
#else
using RayContext = RTCIntersectContext;

inline void trace_closest(RTCScene scene, RayContext& context, RTCRayHit& ray) {
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
}
inline void trace_any(RTCScene scene, RayContext& context, RTCRay& ray) {
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}
#endif

}  // namespace cuticle::strands
