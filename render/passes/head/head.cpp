#include "render/passes/head/head.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "render/frame.h"
#include "render/inputs.h"
#include "render/passes/surface_shadow/surface_shadow.h"
#include "render/shading.h"

#include <glm/geometric.hpp>

namespace cuticle::render::head {

namespace {

constexpr std::string_view k_demands[] = {"head"};
constexpr Use k_uses[] = {reads<FrameView>(),
                          reads<Lights>(),
                          reads<FibreOpacity>(),
                          reads<Surfaces>(),
                          reads<Targets>(),
                          may_read<HeadVertices>(),
                          may_read<surface_shadow::Maps>(),
                          changes<DrawnSurfaces>()};
float nearest_distance(const glm::vec3& point, std::span<const glm::vec3> others) {
  float nearest = std::numeric_limits<float>::max();
  for (const glm::vec3& other : others) nearest = std::min(nearest, glm::dot(other - point, other - point));
  return std::sqrt(nearest);
}

float scalp_share(const glm::vec3& point, const strands::Mesh* scalp) {
  constexpr float k_full = 0.008f, k_none = 0.018f;
  if (!scalp || scalp->positions.empty()) return 0;
  return std::clamp((k_none - nearest_distance(point, scalp->positions)) / (k_none - k_full), 0.0f, 1.0f);
}

}  // namespace

std::vector<float> scalp_shares(const strands::Mesh& head, const strands::Mesh* scalp) {
  std::vector<float> shares;
  for (const glm::vec3& point : head.positions) shares.push_back(scalp_share(point, scalp));
  return shares;
}

void describe(registry::Members& members, Parameters& p) {
  members(p.skin, "skin", "1", 0, 1, "diffuse albedo of the face");
  members(p.scalp, "scalp", "1", 0, 1, "diffuse albedo where hair grows, close to that of the hair's depth");
  members(p.wrap, "wrap", "1", 0, 1, "light carried past the terminator");
  members(p.ambient, "ambient", "1", 0, 1, "share of the lights' sum that arrives from everywhere");
  members(p.bleed, "bleed", "1", 0, 1,
          "as of light under skin: red is carried so much farther past the terminator, and blue less far");
}

const Pass& entry() {
  static const Pass pass =
      with_uses(shading({.name = "head",
                         .summary = "the head's mesh, diffuse, drawn first so that it hides what is behind it",
                         .source = "wrap term: Nguyen and Donnelly 2005, GPU Gems 2, chapter 23.3",
                         .parameters = registry::table_of<Parameters>(),
                         .demands = k_demands,
                         .draws = 1}),
                k_uses);
  return pass;
}

}  // namespace cuticle::render::head
