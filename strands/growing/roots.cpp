#include "strands/growing/roots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "strands/growing/random.h"
#include "strands/growing/root_rules.glslh"

namespace cuticle::strands {

namespace {

constexpr std::uint32_t k_digits = 12;  // of a triangular point: below the resolution of float weights
/// Steps of three additive recurrences that are even together: 2^32 over x, x^2 and x^3 for x^4 = x + 1.
constexpr std::uint32_t k_steps[] = {3518319155u, 2882110345u, 2360945575u};

glm::vec3 weights_of(const glm::vec2& yz) { return {1 - yz.x - yz.y, yz.x, yz.y}; }

/// Running sums of what each triangle can carry: twice its area times the mean density of its corners.
struct Carrier {
  std::vector<double> sums;
  std::vector<float> densities;  ///< per vertex; empty: 1
  RootReport report;

  double total() const { return sums.empty() ? 0 : sums.back(); }
  float density(std::uint32_t vertex) const { return densities.empty() ? 1.0f : densities[vertex]; }
};

bool is_usable(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  return std::all_of(triangle.begin(), triangle.end(),
                     [&](std::uint32_t corner) { return corner < mesh.positions.size(); });
}

/// Twice the area; 0 for a triangle that is degenerate, not finite or names no vertex.
double double_area(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  if (!is_usable(mesh, triangle)) return 0;
  const glm::dvec3 a(mesh.positions[triangle[0]]), b(mesh.positions[triangle[1]]), c(mesh.positions[triangle[2]]);
  const double area = glm::length(glm::cross(b - a, c - a));
  return std::isfinite(area) ? area : 0;
}

void take_map(std::span<const float> map, Carrier& carrier) {
  carrier.densities.assign(map.begin(), map.end());
  for (float& density : carrier.densities)
    if (!std::isfinite(density) || density < 0) {
      density = 0;
      ++carrier.report.bad_densities;
    }
}

Carrier carrier_of(const Mesh& mesh, std::span<const float> map) {
  Carrier carrier;
  take_map(map, carrier);
  double sum = 0;
  for (const auto& triangle : mesh.triangles) {
    const double area = double_area(mesh, triangle);
    double density = 0;
    if (area > 0)
      for (std::uint32_t corner : triangle) density += double(carrier.density(corner)) / 3;
    carrier.report.degenerate_triangles += area > 0 ? 0 : 1;
    carrier.report.bare_triangles += area > 0 && density == 0 ? 1 : 0;
    carrier.sums.push_back(sum += area * density);
  }
  return carrier;
}

/// Finds roots one by one for one rule.
class RootFinder {
 public:
  RootFinder(const Mesh& mesh, const Carrier& carrier, const RootRequest& request)
      : mesh_(mesh), carrier_(carrier), request_(request), found_(mesh.triangles.size(), 0) {
    for (std::uint32_t k = 0; k < 256; ++k) table_[k] = triangular_van_der_corput<float>(k, 4);
    RandomStream shift(request.seed);
    for (std::uint32_t& word : shift_) word = shift.next_word();
  }

  Root find(std::uint32_t strand) {
    if (request_.rule == RootRule::folded) return at_random(strand);
    const double place = double(sequence(strand, 0)) * carrier_.total();
    Root root{triangle_at(place), {}};
    root.weights =
        accepted(root.triangle, [&](std::uint32_t attempt) { return even_place(root.triangle, strand, attempt); });
    return root;
  }

 private:
  static constexpr std::uint32_t k_attempts = 32;

  std::uint32_t triangle_at(double place) const {
    const auto found = std::upper_bound(carrier_.sums.begin(), carrier_.sums.end(), place);
    const auto last = std::lower_bound(carrier_.sums.begin(), carrier_.sums.end(), carrier_.total());
    return std::uint32_t(std::min(found, last) - carrier_.sums.begin());
  }

  Root at_random(std::uint32_t strand) {
    RandomStream random = random_stream(request_.seed, Chance::root, strand);
    Root root{triangle_at(random.next_unit() * carrier_.total()), {}};
    root.weights = accepted(root.triangle, [&](std::uint32_t) {
      const double u = random.next_unit();
      return folded<double>(u, random.next_unit());
    });
    return root;
  }

  float sequence(std::uint32_t k, std::size_t axis) const { return recurrence<float>(k, k_steps[axis], shift_[axis]); }

  glm::vec2 even_place(std::uint32_t triangle, std::uint32_t strand, std::uint32_t attempt) {
    switch (request_.rule) {
      case RootRule::table:
        return table_[table_entry(strand + attempt * 0x9E3779B9u, std::uint32_t(request_.seed))];
      case RootRule::van_der_corput:
        return triangular_van_der_corput<float>(
            found_[triangle]++ + 4096 * table_entry(triangle, std::uint32_t(request_.seed)), k_digits);
      default:
        return folded<float>(sequence(strand + attempt * 0x10001u, 1), sequence(strand + attempt * 0x10001u, 2));
    }
  }

  /// Places are refused in proportion to what the density there lacks of the triangle's greatest.
  template <class Place>
  glm::vec3 accepted(std::uint32_t triangle, const Place& place_of) const {
    const auto& corners = mesh_.triangles[triangle];
    const glm::vec3 densities(carrier_.density(corners[0]), carrier_.density(corners[1]), carrier_.density(corners[2]));
    const float greatest = std::max({densities.x, densities.y, densities.z});
    glm::vec3 weights{0};
    for (std::uint32_t attempt = 0; attempt < k_attempts; ++attempt) {
      weights = weights_of(glm::vec2(place_of(attempt)));
      if (glm::dot(weights, densities) >= threshold_at(triangle, attempt, weights) * greatest) break;
    }
    return weights;
  }

  /// In [0, 1): by the bits of the place itself, so that no further numbers are drawn where density is even.
  float threshold_at(std::uint32_t triangle, std::uint32_t attempt, const glm::vec3& weights) const {
    const auto bits = std::uint32_t(weights.y * 16777216.0f) * 0x2C1B3C6Du + std::uint32_t(weights.z * 16777216.0f);
    return (float(table_entry(bits ^ triangle, attempt)) + 0.5f) / 256;
  }

  const Mesh& mesh_;
  const Carrier& carrier_;
  const RootRequest& request_;
  std::vector<std::uint32_t> found_;  ///< roots that each triangle has so far
  std::array<glm::vec2, 256> table_;
  std::array<std::uint32_t, 3> shift_{};
};

std::vector<Root> find_roots(const Mesh& mesh, const Carrier& carrier, const RootRequest& request, std::size_t count) {
  RootFinder finder(mesh, carrier, request);
  std::vector<Root> roots(count);
  for (std::size_t i = 0; i < count; ++i) roots[i] = finder.find(std::uint32_t(i));
  return roots;
}

Result<void> check_request(const Mesh& mesh, const RootRequest& request) {
  if (!(request.density >= 0 && std::isfinite(request.density)))
    return bad_input(fmt::format("density = {} strands per square metre: allowed is 0 or more", request.density));
  if (!(request.share >= 0 && request.share <= 1))
    return bad_input(fmt::format("share of strands = {}: allowed is 0 .. 1", request.share));
  if (!request.density_map.empty() && request.density_map.size() != mesh.positions.size())
    return bad_input(
        fmt::format("density map: {} entries for {} vertices", request.density_map.size(), mesh.positions.size()));
  return {};
}

/// The 64th of a triangle, three times cut in four, in which a root lies.
std::size_t cell_of(const Root& root) {
  constexpr int side = 8;
  const double u = double(root.weights.y) * side, v = double(root.weights.z) * side;
  const int i = std::clamp(int(u), 0, side - 1), j = std::clamp(int(v), 0, side - 1 - i);
  return std::size_t(2 * (i * side + j) + (i + j < side - 1 && u - i + v - j > 1 ? 1 : 0));
}

/// Share of the triangle's area with weights.y < a and weights.z < b.
double corner_box_share(double a, double b) {
  const double over = std::max(a + b - 1, 0.0);
  return 2 * a * b - over * over;
}

}  // namespace

std::vector<Root> scatter_roots(const Mesh& scalp, std::size_t count, std::uint64_t seed) {
  const Carrier carrier = carrier_of(scalp, {});
  CUTICLE_EXPECT(count == 0 || carrier.total() > 0, "a scalp without area");
  return find_roots(scalp, carrier, {.seed = seed}, count);
}

std::vector<Root> identity_roots(std::size_t strand_count) {
  std::vector<Root> roots(strand_count);
  for (std::size_t s = 0; s < strand_count; ++s) roots[s] = {std::uint32_t(s), {1, 0, 0}};
  return roots;
}

Result<PlacedRoots> place_roots(const Mesh& mesh, const RootRequest& request) {
  CUTICLE_TRY(check_request(mesh, request));
  const Carrier carrier = carrier_of(mesh, request.density_map);
  const double count = std::round(0.5 * carrier.total() * request.density * request.share);
  if (!(count <= k_max_roots))
    return bad_input(fmt::format("density: {:.4g} strands; allowed are 0 .. {:.0f}", count, k_max_roots),
                     "lower the density or the share of strands");
  return PlacedRoots{find_roots(mesh, carrier, request, std::size_t(count)), carrier.report};
}

Evenness evenness(std::span<const Root> roots) {
  constexpr int side = 31;  // no power of two, which would fall on the edges of the triangular sequence
  std::vector<double> cells(128, 0), boxes(side * side, 0);
  for (const Root& root : roots) {
    cells[cell_of(root)] += 1;
    const int i = std::min(int(root.weights.y * side), side - 1), j = std::min(int(root.weights.z * side), side - 1);
    boxes[std::size_t(i * side + j)] += 1;
  }
  Evenness result;
  const double expected = double(roots.size()) / 64;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; i + j < 8; ++j)
      for (int half = 0; half < (i + j < 7 ? 2 : 1); ++half)
        result.chi_square += std::pow(cells[std::size_t(2 * (8 * i + j) + half)] - expected, 2) / expected;
  for (int i = 0; i < side; ++i)  // counts of cells become counts of boxes from the corner
    for (int j = 0; j < side; ++j) {
      double& sum = boxes[std::size_t(i * side + j)];
      if (i > 0) sum += boxes[std::size_t((i - 1) * side + j)];
      if (j > 0) sum += boxes[std::size_t(i * side + j - 1)];
      if (i > 0 && j > 0) sum -= boxes[std::size_t((i - 1) * side + j - 1)];
      const double share = corner_box_share((i + 1.0) / side, (j + 1.0) / side);
      result.discrepancy = std::max(result.discrepancy, std::abs(sum / double(roots.size()) - share));
    }
  return result;
}

}  // namespace cuticle::strands
