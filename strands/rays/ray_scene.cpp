#include "strands/rays/ray_scene.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/core.h>
#include <glm/common.hpp>

#include "strands/rays/detail/curve_set.h"
#include "strands/rays/detail/embree_scene.h"
#include "strands/rays/round_cone.h"

namespace cuticle::strands {

namespace {

/// Surfaces are not met nearer than this, so that a ray that leaves one does not meet it again, metres.
constexpr float k_off_surface = 1e-5f;
constexpr unsigned k_fibres = 0;  ///< geometry; surfaces follow

}  // namespace

struct RayScene::Impl {
  EmbreeScene tree;
  std::vector<RaySegment> segments;
  std::vector<glm::vec4> spheres, spheres_at_end;  ///< at_end: empty where nothing moves
  std::vector<std::uint32_t> offsets;
  CurveKind kind;
  CurveSet curves;  ///< in the place of segments and spheres, where the kind is not the cone

  Result<void> build(const Groom& groom, std::span<const Mesh> surfaces, std::span<const glm::vec3> positions_at_end,
                     std::span<const Mesh> surfaces_at_end);
  void add_cones(const Groom& groom, std::span<const glm::vec3> positions_at_end);
  void add_curves(const Groom& groom, std::span<const glm::vec3> positions_at_end);
  glm::vec4 sphere_at(std::uint32_t vertex, float time) const {
    return spheres_at_end.empty() ? spheres[vertex] : glm::mix(spheres[vertex], spheres_at_end[vertex], time);
  }
};

namespace {

/// Embree's query context with the ray in double and what the filter found.
struct Query {
  RayContext context;  ///< first, so that Embree's pointer is ours
  const RayScene::Impl* scene;
  glm::dvec3 origin, direction;
  FibreLeft from;
  double limit;  ///< hits from here on do not count
  float time;
  double left_at = -1;    ///< where the ray is out of the fibre that it leaves; negative: not asked yet
  CurvePlace place = {};  ///< of the hit on a curve

  LineInterval interval(std::uint32_t vertex) const {
    return round_cone_interval(origin, direction, scene->sphere_at(vertex, time), scene->sphere_at(vertex + 1, time));
  }
};

/// How far the ray runs inside segments of its own strand that overlap one after the other, in both directions.
double leaves_at(const Query& query) {
  const FibreLeft& from = query.from;
  const std::vector<std::uint32_t>& offsets = query.scene->offsets;
  const double slack = 1e-3 * double(query.scene->spheres[from.vertex].w);
  double out = std::max(0.0, query.interval(from.vertex).last);
  const auto extend = [&](std::uint32_t vertex) {
    const LineInterval more = query.interval(vertex);
    const bool overlaps = more.last >= 0 && more.first <= out + slack;
    if (overlaps) out = std::max(out, more.last);
    return overlaps;
  };
  for (std::uint32_t v = from.vertex + 1; v + 1 < offsets[from.strand + 1] && extend(v);) ++v;
  for (std::uint32_t v = from.vertex; v > offsets[from.strand] && extend(v - 1);) --v;
  return out + slack;
}

/// Takes a fibre's hit where the ray enters the cone itself, and puts its distance into the ray.
bool takes(Query& query, unsigned primitive, float& distance) {
  const RaySegment& segment = query.scene->segments[primitive];
  const LineInterval inside = query.interval(segment.first);
  if (!(inside.first > 0) || !(inside.first < query.limit)) return false;
  if (segment.strand == query.from.strand) {
    if (query.left_at < 0) query.left_at = leaves_at(query);
    if (inside.first <= query.left_at) return false;
  }
  query.limit = inside.first;
  distance = float(inside.first);
  return true;
}

void filter_fibre(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& query = *reinterpret_cast<Query*>(arguments->context);
  auto& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  if (!takes(query, hit.primID, ray.tfar)) arguments->valid[0] = 0;
}

/// How far the ray does not meet the curve that it leaves. A round one has only sides that it enters by, so that
/// rounding alone has to be kept away; a ribbon faces the ray from wherever it begins in its width.
double leaves_curve_at(const Query& query) {
  const FibreLeft& from = query.from;
  const CurvePlace place{from.strand, from.vertex, from.share};
  const CurveSpan span = query.scene->curves.span_at(place, double(query.time));
  const double u = query.scene->curves.parameter(place), slack = 1e-3 * span.at(u).w;
  if (!query.scene->kind.is_flat) return slack;
  return leaves_tube_at(span, {query.origin, query.direction}, u) + slack;
}

/// Where the ray enters the span of a primitive, or else one beside it: the wider tube that Embree is asked for may be
/// entered by another span than the fibre.
struct Entered {
  unsigned primitive;
  CurveHit hit;
};
std::optional<Entered> round_entry_near(const Query& query, unsigned primitive, const CurveHit& guess) {
  const CurveSet& curves = query.scene->curves;
  std::optional<Entered> nearest;
  const auto ask = [&](unsigned of, double u) {
    const CurveSpan span = curves.span(of, double(query.time));
    const auto hit = round_entry(span, {query.origin, query.direction}, {guess.distance, u});
    if (hit && (!nearest || hit->distance < nearest->hit.distance)) nearest = {of, *hit};
  };
  ask(primitive, guess.u);
  if (nearest) return nearest;
  const auto is_of_strand = [&](unsigned of) { return curves.strand(of) == curves.strand(primitive); };
  if (primitive > 0 && is_of_strand(primitive - 1)) ask(primitive - 1, 1);
  if (primitive + 1 < curves.first().size() && is_of_strand(primitive + 1)) ask(primitive + 1, 0);
  return nearest;
}

std::optional<Entered> entry_near(const Query& query, unsigned primitive, const CurveHit& guess) {
  if (!query.scene->kind.is_flat) return round_entry_near(query, primitive, guess);
  const CurveSpan span = query.scene->curves.span(primitive, double(query.time));
  const auto hit = flat_entry(span, {query.origin, query.direction}, guess);
  return hit ? std::optional<Entered>({primitive, *hit}) : std::nullopt;
}

/// As `takes`, of curves.
bool takes_curve(Query& query, const CurveHit& guess, unsigned primitive, float& distance) {
  const CurveSet& curves = query.scene->curves;
  const auto entered = entry_near(query, primitive, guess);
  if (!entered || !(entered->hit.distance > 0) || !(entered->hit.distance < query.limit)) return false;
  if (curves.strand(primitive) == query.from.strand) {
    if (query.left_at < 0) query.left_at = leaves_curve_at(query);
    if (entered->hit.distance <= query.left_at) return false;
  }
  query.limit = entered->hit.distance;
  query.place = curves.place(entered->primitive, entered->hit.u);
  distance = float(entered->hit.distance);
  return true;
}

void filter_curve(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& query = *reinterpret_cast<Query*>(arguments->context);
  auto& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  if (!takes_curve(query, {double(ray.tfar), double(hit.u)}, hit.primID, ray.tfar)) arguments->valid[0] = 0;
}

/// A surface that the ray leaves is not met again.
void filter_surface(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& query = *reinterpret_cast<Query*>(arguments->context);
  const float distance = reinterpret_cast<const RTCRay*>(arguments->ray)->tfar;
  if (distance < k_off_surface || !(double(distance) < query.limit))
    arguments->valid[0] = 0;
  else
    query.limit = double(distance);
}

}  // namespace

Result<void> RayScene::Impl::build(const Groom& groom, std::span<const Mesh> surfaces,
                                   std::span<const glm::vec3> positions_at_end, std::span<const Mesh> surfaces_at_end) {
  CUTICLE_TRY(tree.open(RTC_BUILD_QUALITY_HIGH));
  if (kind.is_cone())
    add_cones(groom, positions_at_end);
  else
    add_curves(groom, positions_at_end);
  for (std::size_t k = 0; k < surfaces.size(); ++k)
    tree.add_mesh(surfaces[k], surfaces_at_end.empty() ? std::span<const glm::vec3>() : surfaces_at_end[k].positions,
                  k_fibres + 1 + unsigned(k), filter_surface);
  return tree.commit(kind.is_cone() ? segments.size() : curves.first().size());
}

void RayScene::Impl::add_cones(const Groom& groom, std::span<const glm::vec3> positions_at_end) {
  spheres = spheres_of(groom);
  for (std::size_t v = 0; v < positions_at_end.size(); ++v)
    spheres_at_end.emplace_back(positions_at_end[v], groom.radii[v]);
  offsets = groom.offsets;
  segments = segments_of(groom, true);
  tree.add_segments(spheres, spheres_at_end, segments, k_fibres, filter_fibre);
}

void RayScene::Impl::add_curves(const Groom& groom, std::span<const glm::vec3> positions_at_end) {
  curves = CurveSet(groom, positions_at_end, kind);
  tree.add_curves(kind, curves.controls(), curves.controls_at_end(), curves.first(), k_fibres, filter_curve);
}

namespace {

Result<void> check_surfaces_at_end(std::span<const Mesh> surfaces, std::span<const Mesh> at_end) {
  if (!at_end.empty() && at_end.size() != surfaces.size())
    return internal_error(
        fmt::format("{} surfaces at the end of the motion, {} before", at_end.size(), surfaces.size()));
  for (std::size_t k = 0; k < at_end.size(); ++k)
    if (!at_end[k].positions.empty() && at_end[k].positions.size() != surfaces[k].positions.size())
      return internal_error(fmt::format("surface {}: {} positions at the end of the motion, {} vertices", k,
                                        at_end[k].positions.size(), surfaces[k].positions.size()));
  return {};
}

}  // namespace

RayScene::RayScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayScene::~RayScene() = default;

Result<std::unique_ptr<RayScene>> RayScene::build(const Groom& groom, std::span<const Mesh> surfaces,
                                                  std::span<const glm::vec3> positions_at_end, CurveKind kind,
                                                  std::span<const Mesh> surfaces_at_end) {
  CUTICLE_TRY(validate(groom, kind));
  CUTICLE_TRY(check_surfaces_at_end(surfaces, surfaces_at_end));
  if (!positions_at_end.empty() && positions_at_end.size() != groom.vertex_count())
    return internal_error(fmt::format("{} positions at the end of the motion, {} vertices", positions_at_end.size(),
                                      groom.vertex_count()));
  auto impl = std::make_unique<Impl>();
  impl->kind = kind;
  CUTICLE_TRY(impl->build(groom, surfaces, positions_at_end, surfaces_at_end));
  return std::unique_ptr<RayScene>(new RayScene(std::move(impl)));
}

RayHit RayScene::closest(const glm::dvec3& origin, const glm::dvec3& direction, const FibreLeft& from,
                         double time) const {
  if (!impl_->tree.may_meet(origin, direction)) return {};
  Query query{{}, impl_.get(), origin, direction, from, std::numeric_limits<double>::infinity(), float(time)};
  RTCRayHit found{ray_of(origin, direction), {}};
  found.ray.time = query.time;
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  trace_closest(impl_->tree.scene(), query.context, found);
  RayHit hit;
  if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.distance = query.limit;
  if (found.hit.geomID == k_fibres) {
    hit.kind = RayHit::Kind::fibre;
    if (impl_->kind.is_cone()) {
      const RaySegment& segment = impl_->segments[found.hit.primID];
      query.place = {segment.strand, segment.first};
    }
    hit.strand = query.place.strand;
    hit.vertex = query.place.vertex;
    hit.share = query.place.share;
  } else {
    hit.kind = RayHit::Kind::surface;
    hit.surface = found.hit.geomID - k_fibres - 1;
    hit.triangle = found.hit.primID;
    hit.barycentrics = {double(found.hit.u), double(found.hit.v)};
  }
  return hit;
}

bool RayScene::is_blocked(const glm::dvec3& origin, const glm::dvec3& direction, double distance, const FibreLeft& from,
                          double time) const {
  Query query{{}, impl_.get(), origin, direction, from, distance, float(time)};
  RTCRay ray = ray_of(origin, direction);
  ray.tfar = float(distance);
  ray.time = query.time;
  trace_any(impl_->tree.scene(), query.context, ray);
  return ray.tfar < 0;
}

CurvePoint RayScene::curve_at(const RayHit& hit, double time) const {
  CUTICLE_EXPECT(!impl_->kind.is_cone(), "a scene of curves");
  const CurvePlace place{hit.strand, hit.vertex, hit.share};
  const CurveSpan span = impl_->curves.span_at(place, time);
  const double u = impl_->curves.parameter(place);
  const glm::dvec4 centre = span.at(u);
  return {glm::dvec3(centre), glm::dvec3(span.slope(u)), centre.w};
}

std::size_t RayScene::memory_bytes() const { return impl_->tree.memory_bytes(); }

}  // namespace cuticle::strands
