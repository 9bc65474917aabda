#include "strands/check/groom_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <unordered_set>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "strands/statistics.h"

namespace cuticle::strands::check {
namespace {

constexpr double k_least_length = 1e-3, k_greatest_length = 2;     // m, of the median strand
constexpr double k_least_radius = 5e-6, k_greatest_radius = 1e-3;  // m, of the median vertex
constexpr double k_greatest_ratio = 1000;                          // of a strand's segments
constexpr double k_max_turned = 1e-3;                              // share of inner vertices
constexpr double k_farthest = 10;                                  // over the distance of nine vertices in ten

Verdict verdict(std::string check, bool passed, std::string measured, std::string mistake, std::string remedy) {
  if (passed) mistake = remedy = "";
  return {std::move(check), passed, std::move(measured), std::move(mistake), std::move(remedy)};
}

Verdict units(const Groom& groom, const GroomStatistics& figures) {
  const double median = figures.length.median;
  return verdict(
      "units", median >= k_least_length && median <= k_greatest_length,
      fmt::format("the median strand is {:.3g} m long ({} .. {} m)", median, k_least_length, k_greatest_length),
      "wrong_unit", fmt::format("--metres-per-unit: {}", guess_units(groom).why));
}

Verdict radius(const GroomStatistics& figures) {
  const double median = figures.radius.median;
  return verdict("radius", median >= k_least_radius && median <= k_greatest_radius,
                 fmt::format("the median radius is {:.3g} m ({} .. {} m)", median, k_least_radius, k_greatest_radius),
                 "wrong_radius", "--radius, or the unit that the file's widths are in");
}

Verdict lengths(const GroomStatistics& figures) {
  const auto without = std::ranges::count(figures.degenerate, false, &DegenerateStrand::has_length);
  return verdict(
      "lengths", figures.degenerate.empty(),
      fmt::format("{} strands with coinciding points, {} of them without length", figures.degenerate.size(), without),
      "repeated_points", "convert with --repair");
}

/// Longest over shortest segment of a strand; segments without length are another check's.
double segment_ratio(std::span<const glm::vec3> strand) {
  double least = 0, greatest = 0;
  for (std::size_t i = 1; i < strand.size(); ++i) {
    const double length = glm::distance(glm::dvec3(strand[i]), glm::dvec3(strand[i - 1]));
    if (length <= 0) continue;
    least = least > 0 ? std::min(least, length) : length;
    greatest = std::max(greatest, length);
  }
  return least > 0 ? greatest / least : 1;
}

Verdict segments(const Groom& groom) {
  double worst = 1;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) worst = std::max(worst, segment_ratio(groom.strand(s)));
  return verdict(
      "segments", worst <= k_greatest_ratio,
      fmt::format("longest over shortest segment of a strand: at most {:.3g} ({:g})", worst, k_greatest_ratio),
      "uneven_points", "points spread evenly along each strand, when it is exported");
}

/// Whether the strand turns back by more than 120 degrees at its vertex i.
bool turns_back(std::span<const glm::vec3> strand, std::size_t i) {
  const glm::dvec3 before = glm::dvec3(strand[i]) - glm::dvec3(strand[i - 1]),
                   after = glm::dvec3(strand[i + 1]) - glm::dvec3(strand[i]);
  return glm::dot(before, after) < -0.5 * glm::length(before) * glm::length(after);
}

Verdict order(const Groom& groom) {
  std::size_t inner = 0, turned = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const std::span<const glm::vec3> strand = groom.strand(s);
    for (std::size_t i = 1; i + 1 < strand.size(); ++i) {
      ++inner;
      turned += turns_back(strand, i) ? 1 : 0;
    }
  }
  return verdict("order", double(turned) <= k_max_turned * double(inner),
                 fmt::format("{} of {} inner vertices turn back by more than 120 degrees (1 in 1000)", turned, inner),
                 "points_out_of_order", "each strand's points in their order, root to tip");
}

Verdict direction(const Groom& groom) {
  std::size_t thinner = 0, thicker = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    if (groom.strand_size(s) == 0) continue;
    const float root = groom.radii[groom.offsets[s]], tip = groom.radii[groom.offsets[s + 1] - 1];
    thinner += tip < 0.99f * root ? 1 : 0;
    thicker += root < 0.99f * tip ? 1 : 0;
  }
  return verdict("direction", thicker <= thinner,
                 thinner + thicker == 0 ? std::string("no strand tapers: not told")
                                        : fmt::format("{} strands taper, {} grow thicker", thinner, thicker),
                 "tip_first", "the points of each strand the other way round");
}

std::string_view bytes_of(std::span<const glm::vec3> strand) {
  return {reinterpret_cast<const char*>(strand.data()), strand.size_bytes()};
}

Verdict copies(const Groom& groom) {
  std::unordered_set<std::string_view> seen;
  seen.reserve(groom.strand_count());
  std::size_t again = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) again += seen.insert(bytes_of(groom.strand(s))).second ? 0 : 1;
  return verdict("copies", again == 0, fmt::format("{} strands hold the points of an earlier one", again),
                 "strands_twice", "layers or files that were put together twice");
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Verdict extent(const Groom& groom) {
  glm::dvec3 middle(0);
  std::vector<double> values(groom.vertex_count());
  for (int c = 0; c < 3; ++c) {
    for (std::size_t v = 0; v < values.size(); ++v) values[v] = double(groom.positions[v][c]);
    middle[c] = median_of(values);
  }
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = glm::distance(glm::dvec3(groom.positions[v]), middle);
  const auto ninth = values.begin() + std::ptrdiff_t(values.size() * 9 / 10);
  std::nth_element(values.begin(), ninth, values.end());
  const double usual = *ninth, farthest = *std::max_element(values.begin(), values.end());
  return verdict("extent", farthest <= k_farthest * usual || farthest == 0,
                 fmt::format("farthest vertex {:.3g} m from the middle, nine in ten within {:.3g} m ({:g} times)",
                             farthest, usual, k_farthest),
                 "stray_points", "vertices that were never set, or strands of another object");
}

}  // namespace

std::vector<Verdict> check_groom(const Groom& groom) {
  if (groom.strand_count() == 0)
    return {verdict("lengths", false, "no strands", "no_strands", "another layer or object of the file")};
  const GroomStatistics figures = statistics(groom);
  return {units(groom, figures), radius(figures),  lengths(figures), segments(groom),
          order(groom),          direction(groom), copies(groom),    extent(groom)};
}

}  // namespace cuticle::strands::check
