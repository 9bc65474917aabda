#include "strands/refine.h"

#include <algorithm>
#include <map>

#include <glm/geometric.hpp>

#include "core/result.h"

namespace cuticle::strands {

namespace {

/// Halves the long edges of a mesh once, those of neighbours at the same places.
class Halver {
 public:
  Halver(Mesh& mesh, double longest_edge) : mesh_(mesh), longest_edge_(longest_edge) {}

  /// Whether any edge was long.
  bool halve_all() {
    std::vector<Triangle> whole;
    whole.swap(mesh_.triangles);
    for (const Triangle& triangle : whole) halve(longest_first(triangle));
    return !middles_.empty();
  }

 private:
  using Triangle = std::array<std::uint32_t, 3>;

  float length(std::uint32_t a, std::uint32_t b) const { return glm::distance(mesh_.positions[a], mesh_.positions[b]); }
  bool is_long(std::uint32_t a, std::uint32_t b) const { return double(length(a, b)) > longest_edge_; }
  Triangle longest_first(Triangle t) const {
    const float ab = length(t[0], t[1]), bc = length(t[1], t[2]), ca = length(t[2], t[0]);
    std::rotate(t.begin(), t.begin() + (ab >= bc && ab >= ca ? 0 : bc >= ca ? 1 : 2), t.end());
    return t;
  }
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] = middles_.try_emplace(std::minmax(a, b), std::uint32_t(mesh_.positions.size()));
    if (!is_new) return found->second;
    mesh_.positions.push_back(0.5f * (mesh_.positions[a] + mesh_.positions[b]));
    if (!mesh_.uv.empty()) mesh_.uv.push_back(0.5f * (mesh_.uv[a] + mesh_.uv[b]));
    return found->second;
  }
  /// The triangle a, b, c, cut where its edge from b to c is long.
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (!is_long(b, c)) {
      mesh_.triangles.push_back({a, b, c});
      return;
    }
    const std::uint32_t between = middle(b, c);
    mesh_.triangles.push_back({a, b, between});
    mesh_.triangles.push_back({a, between, c});
  }
  void halve(const Triangle& t) {
    if (!is_long(t[0], t[1])) {
      mesh_.triangles.push_back(t);
      return;
    }
    const std::uint32_t between = middle(t[0], t[1]);
    add(between, t[1], t[2]);
    add(between, t[2], t[0]);
  }

  Mesh& mesh_;
  double longest_edge_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

}  // namespace

Mesh refined(const Mesh& mesh, double longest_edge) {
  CUTICLE_EXPECT(longest_edge > 0, "edges are halved until they are shorter than something");
  Mesh fine = mesh;
  while (Halver(fine, longest_edge).halve_all()) {
  }
  compute_normals(fine);
  return fine;
}

}  // namespace cuticle::strands
