#include "strands/rays/rays.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "strands/rays/detail/embree_scene.h"
#include "strands/rays/round_cone.h"

namespace cuticle::strands {

namespace {

/// Embree's query context, with the segments that the filter was told of.
struct Collector {
  RayContext context;                  ///< first, so that Embree's pointer is ours
  std::array<std::uint32_t, 2> first;  ///< segment of each geometry
  std::vector<std::uint32_t> segments;
};

/// Takes every segment down and refuses its hit, so that the traversal goes on to the end.
void collect_hit(const RTCFilterFunctionNArguments* arguments) {
  auto* collector = reinterpret_cast<Collector*>(arguments->context);
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  if (arguments->valid[0] == 0) return;
  collector->segments.push_back(collector->first[hit->geomID] + hit->primID);
  arguments->valid[0] = 0;
}

}  // namespace

struct RayGroom::Impl {
  EmbreeScene tree;
  std::vector<RaySegment> segments;  ///< those with a length, then those without
  std::uint32_t with_length = 0;
  std::vector<glm::vec4> spheres;  ///< of the vertices: position, radius

  Result<void> build(const Groom& groom);
};

Result<void> RayGroom::Impl::build(const Groom& groom) {
  spheres = spheres_of(groom);
  segments = segments_of(groom, true);
  with_length = std::uint32_t(segments.size());
  const std::vector<RaySegment> points = segments_of(groom, false);
  CUTICLE_TRY(tree.open(RTC_BUILD_QUALITY_MEDIUM));
  tree.add_segments(spheres, {}, segments, 0, collect_hit);
  tree.add_points(spheres, points, 1, collect_hit);
  segments.insert(segments.end(), points.begin(), points.end());
  return tree.commit(segments.size());
}

RayGroom::RayGroom(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayGroom::~RayGroom() = default;

Result<std::unique_ptr<RayGroom>> RayGroom::build(const Groom& groom) {
  CUTICLE_TRY(validate(groom));
  auto impl = std::make_unique<Impl>();
  CUTICLE_TRY(impl->build(groom));
  return std::unique_ptr<RayGroom>(new RayGroom(std::move(impl)));
}

namespace {

/// Joins the overlapping intervals of one strand; `crossings` sorted by (strand, entry).
void join_overlaps(std::vector<Crossing>& crossings) {
  std::size_t kept = 0;
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    Crossing& last = crossings[kept];
    if (crossings[i].strand == last.strand && crossings[i].entry <= last.exit)
      last.exit = std::max(last.exit, crossings[i].exit);
    else
      crossings[++kept] = crossings[i];
  }
  if (!crossings.empty()) crossings.resize(kept + 1);
}

}  // namespace

void RayGroom::all_crossings(const glm::dvec3& origin, const glm::dvec3& direction,
                             std::vector<Crossing>& crossings) const {
  thread_local Collector collector;
  collector.first = {0, impl_->with_length};
  collector.segments.clear();
  RTCRayHit query{ray_of(origin, direction), {}};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  trace_closest(impl_->tree.scene(), collector.context, query);
  std::vector<std::uint32_t>& found = collector.segments;
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  crossings.clear();
  for (const std::uint32_t i : found) {
    const RaySegment& segment = impl_->segments[i];
    const glm::vec4* ends = &impl_->spheres[segment.first];
    const LineInterval interval = round_cone_interval(origin, direction, ends[0], ends[1]);
    if (interval.last > std::max(0.0, interval.first))
      crossings.push_back({segment.strand, float(std::max(0.0, interval.first)), float(interval.last)});
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.strand != b.strand ? a.strand < b.strand : a.entry < b.entry;
  });
  join_overlaps(crossings);
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.entry != b.entry ? a.entry < b.entry : a.strand < b.strand;
  });
}

}  // namespace cuticle::strands
