#pragma once
// Roots of drawn strands: how many, on which triangle, where in it.
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "strands/mesh.h"

namespace cuticle::strands {

/// N5: for each drawn strand a triangle of the growth mesh and barycentric weights.
struct Root {
  std::uint32_t triangle = 0;
  glm::vec3 weights{1, 0, 0};  ///< of the triangle's three control hairs; sum 1
};

/// How a root's place is found. `folded` (N5): Philox numbers, folded. `table` (H8): 256 fixed places, chosen by a hash
/// of the strand. `recurrence`: an additive recurrence over surface and triangle, folded. `van_der_corput`: the
/// triangular sequence within each triangle. The last two are even: roots keep apart. Of every rule a prefix is a
/// smaller set of its own.
enum class RootRule { folded, table, recurrence, van_der_corput };
inline constexpr std::string_view k_root_rules[] = {"folded", "table", "recurrence", "van_der_corput"};

/// `count` roots by area, rule `folded`.
std::vector<Root> scatter_roots(const Mesh& scalp, std::size_t count, std::uint64_t seed);

/// For a groom of its own (a file): each strand is its own control hair; `triangle` is then the strand, the weights are
/// 1, 0, 0.
std::vector<Root> identity_roots(std::size_t strand_count);

struct RootRequest {
  double density = 1e5;                     ///< strands per square metre, >= 0
  double share = 1;                         ///< level of detail: share of the strands, 0 .. 1
  std::span<const float> density_map = {};  ///< factor per mesh vertex, linear between; empty: 1 everywhere
  RootRule rule = RootRule::folded;
  std::uint64_t seed = 1;
};
/// What could not carry hair.
struct RootReport {
  std::size_t degenerate_triangles = 0;  ///< without area, with a corner that is not finite, or that names no vertex
  std::size_t bare_triangles = 0;        ///< density 0 at all corners
  std::size_t bad_densities = 0;         ///< entries of the map that are negative or not finite, taken as 0
};
struct PlacedRoots {
  std::vector<Root> roots;
  RootReport report;
};
/// H8: area x density x share strands, rounded; fewer where the map leaves no place. Error: bad_input where density or
/// share is out of range or not a number, the map has not one entry a vertex, or the count passes k_max_roots.
Result<PlacedRoots> place_roots(const Mesh& mesh, const RootRequest& request);
inline constexpr double k_max_roots = 1e7;

/// How even roots lie in their triangles: all of them in one triangle.
struct Evenness {
  double chi_square = 0;   ///< over 64 equal triangles; 63 degrees of freedom, so about 63 for independent roots
  double discrepancy = 0;  ///< largest difference between share of roots and share of area over 961 corner boxes
};
Evenness evenness(std::span<const Root> roots);

}  // namespace cuticle::strands
