#pragma once
// Hair as data: strands as structure-of-arrays, in metres, root first.
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/result.h"

namespace cuticle::strands {

/// A named float attribute, `components` values per strand or per vertex.
struct Attribute {
  enum class Domain { strand, vertex } domain = Domain::vertex;
  int components = 1;
  std::vector<float> values;
  bool operator==(const Attribute&) const = default;
};

/// Strands. Vertices of strand s: [offsets[s], offsets[s + 1]), root to tip.
struct Groom {
  std::vector<std::uint32_t> offsets{0};          ///< strand_count + 1 entries
  std::vector<glm::vec3> positions;               ///< metres
  std::vector<float> radii;                       ///< metres, one per vertex
  std::vector<glm::vec2> root_uv;                 ///< one per strand, or empty
  std::vector<std::uint32_t> root_triangle;       ///< triangle of the growth mesh, one per strand, or empty
  std::vector<glm::vec2> root_barycentrics;       ///< weights of the triangle's 2nd and 3rd corner, or empty
  std::map<std::string, Attribute> attributes;    ///< "color", "transparency", ...

  std::size_t strand_count() const { return offsets.size() - 1; }
  std::size_t vertex_count() const { return positions.size(); }
  std::size_t strand_size(std::size_t strand) const { return offsets[strand + 1] - offsets[strand]; }
  std::span<const glm::vec3> strand(std::size_t s) const { return {positions.data() + offsets[s], strand_size(s)}; }
  bool operator==(const Groom&) const = default;
};

/// What a file's units seem to be, and why ("strands of 45 units: taken as centimetres").
struct UnitGuess {
  double metres_per_unit = 1;
  std::string why;
};
/// From the groom's own lengths and bounds, in file units: a head of hair is 0.05 .. 1.2 m long and 0.1 .. 2 m wide.
UnitGuess guess_units(const Groom& groom_in_file_units);
/// Scales positions and radii.
void scale(Groom& groom, double factor);
/// Adds the strands of another groom. Root uv, roots and attributes are kept where both have them in the same form. The
/// vertices of both together must be at most 0xffffffff.
void append(Groom& groom, const Groom& part);
/// Default fibre radius, metres (35 micrometres: the middle of the 17-50 of human hair), used where a file has none.
inline constexpr float k_default_radius = 35e-6f;

struct Bounds {
  glm::vec3 lower{0}, upper{0};
  bool operator==(const Bounds&) const = default;
};
Bounds bounds(const Groom& groom);
/// Arc length of a strand, metres.
double strand_length(const Groom& groom, std::size_t strand);
/// Structure check: offsets rising and in range, sizes consistent, all finite. Error: internal names the field.
Result<void> validate(const Groom& groom);
/// Unit tangents per vertex (central differences; the strand's mean direction, or +y, where points coincide).
std::vector<glm::vec3> tangents(const Groom& groom);

}  // namespace cuticle::strands
