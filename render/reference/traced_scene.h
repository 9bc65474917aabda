#pragma once
// What the reference draws: hair, its model, surfaces, lights, camera. World space, metres, linear radiance.
#include <algorithm>
#include <optional>
#include <vector>

#include "bsdf/model.h"
#include "core/image/image.h"
#include "core/view.h"
#include "strands/groom.h"
#include "strands/mesh.h"

namespace cuticle::render::reference {

/// A diffuse mesh, seen and lit from both sides.
struct Surface {
  strands::Mesh mesh;
  std::vector<glm::vec3> albedo;  ///< one per vertex, 0 .. 1
  strands::Mesh at_end = {};      ///< where it is when the shutter closes; no vertices: it stands
};

/// Radiance from all around, as scene::Environment lays it out.
struct Surroundings {
  Image picture;
  double turn_degrees = 0, scale = 1;
};

struct TracedScene {
  strands::Groom hair;  ///< each segment a round cone
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;  ///< of the model
  std::vector<Light> lights;
  std::optional<Surroundings> surroundings;  ///< light hair and surfaces; the camera does not see them
  std::vector<Surface> surfaces;
  Camera camera;
  /// Where vertices and camera are when the shutter closes; it opens at the above, and all moves evenly between. Empty:
  /// still. Lights stand; a restriction to a shadow method is that of the shutter's opening.
  std::vector<glm::vec3> positions_at_end = {};
  std::optional<Camera> camera_at_end = {};

  bool moves() const {
    return !positions_at_end.empty() || camera_at_end.has_value() ||
           std::ranges::any_of(surfaces, [](const Surface& surface) { return !surface.at_end.positions.empty(); });
  }
};

}  // namespace cuticle::render::reference
