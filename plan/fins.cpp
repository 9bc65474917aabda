#include "plan/fins.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/core.h>

#include "core/image/image.h"
#include "strands/formats/formats.h"

namespace cuticle::plan {
namespace {

strands::Mesh one_vertex_a_place(const strands::Mesh& mesh) {
  strands::Mesh joined;
  std::map<std::tuple<float, float, float>, std::uint32_t> vertices;
  std::vector<std::uint32_t> vertex_of;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    const auto [found, is_new] = vertices.try_emplace({p.x, p.y, p.z}, std::uint32_t(joined.positions.size()));
    vertex_of.push_back(found->second);
    if (!is_new) continue;
    joined.positions.push_back(p);
    joined.uv.push_back(mesh.uv[i]);
  }
  for (const auto& [a, b, c] : mesh.triangles) joined.triangles.push_back({vertex_of[a], vertex_of[b], vertex_of[c]});
  strands::compute_normals(joined);
  return joined;
}

/// The map's first channel between its texels.
float painted(const Image& map, const glm::vec2& uv) {
  const auto texel = [](double share, int count) { return std::clamp(share * count - 0.5, 0.0, double(count - 1)); };
  const double x = texel(double(uv.x), map.width), y = texel(1 - double(uv.y), map.height);
  const int left = int(x), top = int(y), right = std::min(left + 1, map.width - 1),
            bottom = std::min(top + 1, map.height - 1);
  const auto row = [&](int y_of_row) {
    return std::lerp(double(map.at(left, y_of_row, 0)), double(map.at(right, y_of_row, 0)), x - left);
  };
  return std::clamp(float(std::lerp(row(top), row(bottom), y - top)), 0.f, 1.f);
}

}  // namespace

Result<void> read_fins(const scene::FinSource& source, StrandSet& set) {
  CUTICLE_ASSIGN(const strands::Mesh mesh, strands::read_obj(source.mesh, source.metres_per_unit));
  if (mesh.uv.empty())
    return bad_input(fmt::format("{}: a corner without texture coordinates: the weight map has no place", source.mesh));
  CUTICLE_ASSIGN(const Image map, read_image(source.weights));
  set.fins = one_vertex_a_place(mesh);
  for (const glm::vec2& uv : set.fins.uv) set.fin_weights.push_back(painted(map, uv));
  return {};
}

}  // namespace cuticle::plan
