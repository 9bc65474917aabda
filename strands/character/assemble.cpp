#include "strands/character/assemble.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace cuticle::strands {

void set_matrix(const glm::dmat4& matrix, Node& node) {
  node.translation = glm::dvec3(matrix[3]);
  glm::dmat3 linear(matrix);
  for (int k = 0; k < 3; ++k) node.scale[k] = glm::length(linear[k]);
  if (glm::determinant(linear) < 0) node.scale.x = -node.scale.x;
  for (int k = 0; k < 3; ++k) linear[k] /= node.scale[k] == 0 ? 1.0 : node.scale[k];
  node.rotation = glm::quat_cast(linear);
}

Result<void> order_nodes(Character& character, const std::string& where) {
  std::vector<std::vector<int>> children(character.nodes.size());
  std::vector<int>& order = character.order;
  for (std::size_t i = 0; i < character.nodes.size(); ++i) {
    const int parent = character.nodes[i].parent;
    (parent < 0 ? order : children[std::size_t(parent)]).push_back(int(i));
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::vector<int>& next = children[std::size_t(order[k])];
    order.insert(order.end(), next.begin(), next.end());
  }
  if (order.size() == character.nodes.size()) return {};
  return bad_input(where + ": nodes: some are their own ancestors");
}

Result<void> check_keys(const Track& track, const std::string& where) {
  for (std::size_t i = 0; i < track.times.size(); ++i)
    if (!std::isfinite(track.times[i]) || track.times[i] < 0 || (i > 0 && track.times[i] < track.times[i - 1]))
      return bad_input(
          fmt::format("{}: key {} at {} s: times must be finite, at least 0 and not fall", where, i, track.times[i]));
  for (std::size_t i = 0; i < track.values.size(); ++i)
    if (!std::isfinite(track.values[i])) return bad_input(fmt::format("{}: value {} is not finite", where, i));
  return {};
}

void scale_to_metres(Character& character, const Convention& convention, const glm::dmat4& turn) {
  glm::vec3 lower = character.mesh.positions.front(), upper = lower;
  for (const glm::vec3& p : character.mesh.positions) lower = glm::min(lower, p), upper = glm::max(upper, p);
  const glm::vec3 side = upper - lower;
  character.metres_per_unit = convention.metres_per_unit;
  if (convention.metres_per_unit == 0) {
    const UnitGuess guess = guess_character_units(double(std::max({side.x, side.y, side.z})));
    character.metres_per_unit = guess.metres_per_unit;
    character.report.notes.push_back(guess.why);
  }
  character.to_metres = turn * glm::dmat4(glm::dmat3(character.metres_per_unit));
  character.mesh = transformed(character.mesh, character.to_metres);
  for (glm::vec3& normal : character.mesh.normals) normal = unit_or_up(normal);
}

}  // namespace cuticle::strands
