#include "study/shadows/probes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "shadows/light_frame.h"
// After the headers that include glm/matrix.hpp: the dialect defines Vec2 and Vec3.
#include "shadows/light_frame.glslh"

namespace cuticle::study {
namespace {

glm::vec3 between(const glm::vec3& a, const glm::vec3& b, float t) { return a + t * (b - a); }

void add_probe(const strands::Groom& groom, std::uint32_t vertex, std::uint32_t strand, float fraction,
               Probes& probes) {
  const std::uint32_t next = std::min(vertex + 1, groom.offsets[strand + 1] - 1);
  probes.points.push_back(between(groom.positions[vertex], groom.positions[next], fraction));
  probes.vertices.push_back(vertex);
  probes.strands.push_back(strand);
  probes.fractions.push_back(fraction);
}

/// The point of a fibre that a pixel sees: of its surface, in the picture, and the point of its axis beside that.
struct Seen {
  glm::vec3 met{0, 0, std::numeric_limits<float>::infinity()};
  float fraction = 0;
  std::uint32_t vertex = 0, strand = 0;
};

/// A square picture of the groom: one ray through the centre of each pixel.
struct Picture {
  shadows::LightAxes axes;
  shadows::LightBox box;
  float pixel = 1;
  std::size_t side = 1;
  std::vector<Seen> seen;

  glm::vec3 view(const glm::vec3& p) const { return shadows::view_point(axes, p) - box.lower; }
  /// A step of the picture, in the world.
  glm::vec3 in_world(const glm::vec3& step) const {
    return step.x * axes.right + step.y * axes.up + step.z * axes.forward;
  }
  /// Pixels first .. last whose centres may lie between two places of a side.
  std::pair<std::size_t, std::size_t> between_places(float a, float b, float margin) const {
    const float first = (std::min(a, b) - margin) / pixel - 0.5f, last = (std::max(a, b) + margin) / pixel - 0.5f;
    return {std::size_t(std::max(0.0f, std::ceil(first))),
            std::size_t(std::clamp(std::floor(last) + 1, 0.0f, float(side)))};
  }
};

/// A segment in the picture, with its radius.
struct Piece {
  glm::vec3 a, b;
  float radius;
  std::uint32_t vertex, strand;
};
/// Where the ray at `at` meets the piece's surface, if it does: before the axis, seen from the camera.
void see(const Piece& piece, const glm::vec2& at, Seen& seen) {
  const glm::vec2 along = glm::vec2(piece.b - piece.a), from = at - glm::vec2(piece.a);
  const float square = glm::dot(along, along);
  const float t = square > 0 ? std::clamp(glm::dot(from, along) / square, 0.0f, 1.0f) : 0.0f;
  const glm::vec2 away = from - t * along;
  const float left = piece.radius * piece.radius - glm::dot(away, away);
  if (!(left > 0)) return;
  // The ray meets the surface of a fibre that leans the farther before the axis the more it leans (at most ten times as
  // far); round ends are met as spheres.
  const bool is_end = t == 0 || t == 1;
  const float length = glm::distance(piece.a, piece.b);
  const float before = std::sqrt(left) / (is_end ? 1 : std::max(0.1f, std::sqrt(square) / length));
  const float depth = between(piece.a, piece.b, t).z - before;
  if (!(depth < seen.met.z)) return;
  const float back = is_end ? 0 : before * (piece.b.z - piece.a.z) / (length * length);
  seen = {{at, depth}, std::clamp(t - back, 0.0f, 1.0f), piece.vertex, piece.strand};
}
void draw(const Piece& piece, Picture& picture) {
  const auto [row, end_row] = picture.between_places(piece.a.y, piece.b.y, piece.radius);
  const float slope = (piece.b.x - piece.a.x) / (piece.b.y - piece.a.y);
  const float reach = piece.radius * std::sqrt(1 + slope * slope);
  for (std::size_t j = row; j < end_row; ++j) {
    const float y = (float(j) + 0.5f) * picture.pixel, x = piece.a.x + (y - piece.a.y) * slope;
    const float least = std::min(piece.a.x, piece.b.x), most = std::max(piece.a.x, piece.b.x);
    const bool is_flat = !std::isfinite(reach);
    const auto [column, end_column] =
        picture.between_places(is_flat ? least : std::clamp(x - reach, least, most),
                               is_flat ? most : std::clamp(x + reach, least, most), piece.radius);
    for (std::size_t i = column; i < end_column; ++i)
      see(piece, {(float(i) + 0.5f) * picture.pixel, y}, picture.seen[j * picture.side + i]);
  }
}

/// Pixels of a side, at least: those of a picture.
constexpr std::size_t k_least_side = 1024;

}  // namespace

Probes spread_probes(const strands::Groom& groom, std::size_t count) {
  const std::size_t vertices = groom.vertex_count(), wanted = std::min(count, vertices);
  std::vector<std::size_t> chosen;
  // Multiples of the golden ratio, so that no period of the strands' vertex counts is met.
  for (std::size_t i = 0; i < wanted; ++i)
    chosen.push_back(
        wanted == vertices ? i : std::size_t(std::fmod(double(i) * 0.6180339887498949, 1.0) * double(vertices)));
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  Probes probes;
  for (const std::size_t v : chosen) {
    const auto after = std::upper_bound(groom.offsets.begin(), groom.offsets.end(), std::uint32_t(v));
    add_probe(groom, std::uint32_t(v), std::uint32_t(after - groom.offsets.begin()) - 1, 0, probes);
  }
  return probes;
}

Probes middle_probes(const strands::Groom& groom, std::size_t count) {
  const Probes ends = spread_probes(groom, count);
  Probes probes;
  for (std::size_t i = 0; i < ends.vertices.size(); ++i) {
    const std::uint32_t v = ends.vertices[i], strand = ends.strands[i], first = groom.offsets[strand];
    const bool is_last = v + 1 == groom.offsets[strand + 1];
    add_probe(groom, is_last ? std::max(first + 1, v) - 1 : v, strand, 0.5f, probes);
  }
  return probes;
}

Probes visible_probes(const strands::Groom& groom, const glm::dvec3& to_camera, std::size_t count) {
  Picture picture;
  picture.axes = shadows::light_axes(to_camera);
  picture.box = shadows::light_box(picture.axes, groom.positions);
  picture.side = std::max(k_least_side, 2 * std::size_t(std::ceil(std::sqrt(double(count)))));
  const glm::vec3 size = picture.box.upper - picture.box.lower;
  picture.pixel = std::max(std::max(size.x, size.y), 1e-9f) / float(picture.side);
  picture.seen.resize(picture.side * picture.side);
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v)
      draw({picture.view(groom.positions[v]), picture.view(groom.positions[v + 1]),
            0.5f * (groom.radii[v] + groom.radii[v + 1]), v, s},
           picture);
  std::erase_if(picture.seen, [](const Seen& seen) { return !std::isfinite(seen.met.z); });
  Probes probes;
  const std::size_t found = picture.seen.size(), wanted = std::min(count, found);
  for (std::size_t i = 0; i < wanted; ++i) {
    const Seen& seen = picture.seen[i * found / wanted];
    add_probe(groom, seen.vertex, seen.strand, seen.fraction, probes);
    const glm::vec3& on_axis = probes.points.back();
    probes.met.push_back(on_axis + picture.in_world(seen.met - picture.view(on_axis)));
  }
  const strands::Bounds bounds = strands::bounds(groom);
  const glm::dvec3 middle = 0.5 * glm::dvec3(bounds.lower + bounds.upper);
  probes.seen_from = middle + 1e3 * double(glm::distance(bounds.lower, bounds.upper)) * to_camera;
  return probes;
}

Probes on_groom(const strands::Groom& groom, Probes probes) {
  Probes moved;
  moved.seen_from = probes.seen_from;
  for (std::size_t i = 0; i < probes.points.size(); ++i)
    add_probe(groom, probes.vertices[i], probes.strands[i], probes.fractions[i], moved);
  return moved;
}

namespace {

std::vector<shadows::SegmentPlace> places_of(const strands::Groom& groom, const Probes& probes) {
  std::vector<shadows::SegmentPlace> places;
  for (std::size_t i = 0; i < probes.points.size(); ++i) {
    const std::uint32_t v = probes.vertices[i], last = groom.offsets[probes.strands[i] + 1] - 1;
    places.push_back({groom.positions[v], groom.positions[std::min(v + 1, last)], probes.fractions[i]});
  }
  return places;
}

Result<shadows::Transmittance> evaluate_with_tents(const Candidate& candidate, const shadows::Casters& casters,
                                                   const Probes& probes) {
  if (!candidate.values.all().contains("weights"))
    return usage_error("no tent weights of planes: not looked up per vertex");
  registry::ParameterValues values = candidate.values;
  values.set("weights", std::string("per_vertex"));
  const std::vector<shadows::SegmentPlace> places = places_of(*casters.groom, probes);
  shadows::Receivers receivers = probes.receivers();
  receivers.segments = places;
  return candidate.method->evaluate(casters, receivers, values);
}

}  // namespace

Result<shadows::Transmittance> evaluate_at(const Candidate& candidate, const shadows::Casters& casters,
                                           const Probes& probes, Weights weights) {
  if (weights == Weights::tents_per_vertex) return evaluate_with_tents(candidate, casters, probes);
  if (weights != Weights::per_vertex) return candidate.method->evaluate(casters, probes.receivers(), candidate.values);
  std::vector<glm::vec3> ends;
  std::vector<std::uint32_t> strands;
  for (const shadows::SegmentPlace& place : places_of(*casters.groom, probes)) {
    ends.insert(ends.end(), {place.from, place.to});
    strands.insert(strands.end(), 2, probes.strands[strands.size() / 2]);
  }
  const shadows::Receivers at_ends{.points = ends, .strands = strands, .seen_from = probes.seen_from};
  CUTICLE_ASSIGN(auto result, candidate.method->evaluate(casters, at_ends, candidate.values));
  for (std::size_t i = 0; i < probes.points.size(); ++i)
    result.values[i] = std::lerp(result.values[2 * i], result.values[2 * i + 1], probes.fractions[i]);
  result.values.resize(probes.points.size());
  return result;
}

}  // namespace cuticle::study
