#pragma once
// Points of a groom at which transmittance is compared.
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/registry/parameter.h"
#include "core/result.h"
#include "shadows/method.h"
#include "strands/groom.h"

namespace cuticle::study {

/// A method with its parameters, as one point of a comparison.
struct Candidate {
  const shadows::Method* method = nullptr;
  registry::ParameterValues values;
};

/// How transmittance comes to a point between two vertices: looked up there, between that of the vertices, or looked up
/// there with tent weights of planes interpolated from the vertices (N19).
enum class Weights { at_vertices, per_fragment, per_vertex, tents_per_vertex };

/// Points that lie a fraction 0 .. 1 of the way from their vertex to the next of their strand.
struct Probes {
  std::vector<glm::vec3> points;
  std::vector<std::uint32_t> vertices, strands;
  std::vector<float> fractions;
  std::optional<glm::dvec3> seen_from = {};  ///< shadows::Receivers::seen_from
  std::vector<glm::vec3> met = {};           ///< shadows::Receivers::met

  shadows::Receivers receivers() const {
    return {.points = points, .strands = strands, .vertices = vertices, .seen_from = seen_from, .met = met};
  }
};

/// `count` of the groom's vertices, spread evenly over the list; all if there are fewer.
Probes spread_probes(const strands::Groom& groom, std::size_t count);

/// The middles of the segments at such vertices, of the one that begins there unless its strand ends there.
Probes middle_probes(const strands::Groom& groom, std::size_t count);

/// What an orthographic camera in the direction `to_camera` (unit) sees, by a ray through the centre of each pixel of a
/// picture at least 1,024 wide: where the ray meets a surface first, and the point of that fibre's axis, seen from
/// afar; `count` of the pixels that see one, spread evenly over the picture; all if there are fewer.
Probes visible_probes(const strands::Groom& groom, const glm::dvec3& to_camera, std::size_t count);

/// The same places on the strands of another groom of as many vertices.
Probes on_groom(const strands::Groom& groom, Probes probes);

/// A method at the probes. Error: usage, for tents_per_vertex and a method without the parameter `weights`.
Result<shadows::Transmittance> evaluate_at(const Candidate& candidate, const shadows::Casters& casters,
                                           const Probes& probes, Weights weights);

}  // namespace cuticle::study
