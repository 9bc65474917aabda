// N1, N6: a control hair on every scalp vertex, grown by small steps along the normal, then the combed flow over the
// head.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "strands/growing/grower.h"
#include "strands/growing/random.h"

namespace cuticle::strands {

namespace {

/// N6: lengths of the segments, each `growth` times the one before, summing to `length`.
std::vector<double> segment_lengths(double length, int segments, double growth) {
  std::vector<double> lengths(std::size_t(segments), 1);
  double sum = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) sum += lengths[i] = std::pow(growth, double(i));
  for (double& segment : lengths) segment *= length / sum;
  return lengths;
}

/// The first point on the path after `at` that lies `distance` from `from`; moves `at` to its place (index + fraction).
glm::dvec3 next_on_path(const std::vector<glm::dvec3>& path, std::size_t& at, const glm::dvec3& from, double distance) {
  while (at + 1 < path.size() && glm::distance(path[at + 1], from) < distance) ++at;
  if (at + 1 >= path.size()) return from + glm::normalize(path.back() - from + glm::dvec3(0, -1e-12, 0)) * distance;
  glm::dvec3 inside = path[at], beyond = path[at + 1];
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 middle = 0.5 * (inside + beyond);
    (glm::distance(middle, from) < distance ? inside : beyond) = middle;
  }
  return beyond;
}

std::vector<glm::dvec3> place_vertices(const std::vector<glm::dvec3>& path, const std::vector<double>& lengths) {
  std::vector<glm::dvec3> hair{path.front()};
  std::size_t at = 0;
  for (double length : lengths) hair.push_back(next_on_path(path, at, hair.back(), length));
  return hair;
}

/// Sets every segment to its length again, root first, keeping directions; vertices stay outside the head.
void restore_lengths(std::vector<glm::dvec3>& hair, const std::vector<double>& lengths, const Grower& grower) {
  for (std::size_t i = 1; i < hair.size(); ++i) {
    for (int pass = 0; pass < 10; ++pass) {
      if (i > 1) hair[i] = grower.outside(hair[i], 1);
      const glm::dvec3 segment = hair[i] - hair[i - 1];
      hair[i] = hair[i - 1] + segment * (lengths[i - 1] / std::max(glm::length(segment), 1e-12));
    }
  }
}

using Hairs = std::vector<std::vector<glm::dvec3>>;

/// About one hair in eight leads; the tips of others move to the nearest leader's.
Hairs clumped(const Hairs& hairs, const Style& style) {
  std::vector<std::size_t> leaders;
  for (std::size_t h = 0; h < hairs.size(); ++h)
    if (random_stream(style.seed, Chance::clump, h).next_unit() < 0.125) leaders.push_back(h);
  Hairs result = hairs;
  if (leaders.empty() || style.clump == 0) return result;
  for (std::size_t h = 0; h < hairs.size(); ++h) {
    const auto gap = [&](std::size_t leader) {
      return glm::distance(hairs[h].front(), hairs[leader].front()) +
             glm::distance(hairs[h].back(), hairs[leader].back());
    };
    const std::size_t leader = *std::min_element(leaders.begin(), leaders.end(),
                                                 [&](std::size_t a, std::size_t b) { return gap(a) < gap(b); });
    for (std::size_t i = 0; i < hairs[h].size(); ++i) {
      const double tip = double(i) / double(hairs[h].size() - 1);
      result[h][i] += style.clump * tip * tip * (hairs[leader][i] - hairs[h][i]);
    }
  }
  return result;
}

Result<void> check_head(const Head& head) {
  if (head.scalp.positions.empty()) return bad_input("head: the scalp has no vertices, at least 1 is needed");
  if (head.scalp.normals.size() != head.scalp.positions.size())
    return bad_input(fmt::format("head: the scalp has {} normals for {} vertices", head.scalp.normals.size(),
                                 head.scalp.positions.size()));
  if (head.mesh.normals.size() != head.mesh.positions.size())
    return bad_input(fmt::format("head: the mesh has {} normals for {} vertices", head.mesh.normals.size(),
                                 head.mesh.positions.size()));
  return {};
}

Groom to_groom(const Hairs& hairs, const Mesh& scalp, double radius) {
  Groom groom;
  for (const std::vector<glm::dvec3>& hair : hairs) {
    for (const glm::dvec3& point : hair) groom.positions.emplace_back(point);
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), float(radius));
  groom.root_uv = scalp.uv;
  return groom;
}

}  // namespace

void describe(registry::Members& members, Style& style) {
  members(style.vertices, "control_vertices", 2, 64, "Vertices of a control hair");
  members(style.length, "length", "m", 0.001, 2, "Length of a hair");
  members(style.variation, "length_variation", "1", 0, 0.9, "Part of the length that chance may take away");
  members(style.growth, "segment_growth", "1", 1, 3, "Length of a segment over the one before it, root to tip");
  members(style.parting, "parting", "1", 0, 1, "Combed straight back (0) or apart from the middle (1)");
  members(style.comb, "comb", "1", 0, 1, "How far hair near the head follows the comb; 0 leaves it on the normal");
  members(style.droop, "droop", "1", -1, 1, "How far hair bends to the ground; 0 leaves it stiff, below 0 it rises");
  members(style.cut_height, "cut_height", "m", -2, 2, "Hair ends where it first falls below this height");
  members(style.volume, "volume", "m", 0.005, 0.1, "Height over the scalp at which combed hair lies");
  members(style.under, "under", "1", 0, 1, "How far the comb holds hair where the skin faces down, as fur");
  members(style.fringe, "fringe", "1", 0.05, 1, "Length at the front hairline over length elsewhere");
  members(style.clump, "clump", "1", 0, 1, "How far tips gather to those of chosen neighbours");
  members(style.radius, "radius", "m", 5e-6, 1e-3, "Fibre radius");
  members(style.seed, "seed", 0, 4294967295.0, "Seed of all chance");
}

Result<Groom> plant_control_hairs(const Head& head, const Style& style, const Grooming& grooming) {
  CUTICLE_TRY(check_head(head));
  const Grower grower(head, style, grooming);
  Hairs hairs(head.scalp.positions.size());
  std::vector<std::vector<double>> lengths(hairs.size());
  tbb::parallel_for(std::size_t(0), hairs.size(), [&](std::size_t v) {
    const double length = grower.length_of(v);
    const std::vector<glm::dvec3> path = grower.path(v, length);
    lengths[v] = segment_lengths(grower.length_on(path, length), style.vertices - 1, style.growth);
    hairs[v] = place_vertices(path, lengths[v]);
  });
  hairs = clumped(hairs, style);
  tbb::parallel_for(std::size_t(0), hairs.size(),
                    [&](std::size_t v) { restore_lengths(hairs[v], lengths[v], grower); });
  return to_groom(hairs, head.scalp, style.radius);
}

}  // namespace cuticle::strands
