#pragma once
// Paths from the camera through hair: next-event estimation of lights, importance-sampled surroundings weighed against
// the model's own samples, Russian roulette, any number of scatterings.
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "render/reference/camera_rays.h"
#include "render/reference/cross_sections.h"
#include "render/reference/dual_scattering.h"
#include "render/reference/random_numbers.h"
#include "render/reference/restrictions.h"
#include "render/reference/traced_scene.h"
#include "strands/curve_kind.h"

namespace cuticle::render::reference {

struct TraceOptions {
  int scatterings = 0;  ///< at most, of a path; 1: direct light alone; 0: all
  std::uint64_t seed = 0;
  bool layers = false;     ///< splits the light, which costs an evaluation of each lobe at the first scattering
  bool strands = false;    ///< keeps what each pixel sees of each strand; not in a state file
  bool far_field = false;  ///< of models that have both fields
  std::optional<TablesInstead> tables = {};    ///< their field is the far one
  std::optional<ShadowsInstead> shadows = {};  ///< of the scene's lights on hair
  /// Of light that scatters more than once at hair; paths end at their first scattering.
  std::optional<DualScatteringInstead> dual_scattering = {};
  Lens lens = {};
  strands::CurveKind curves = {};  ///< what the hair's vertices are
  Turning turning = {};            ///< of flat cross-sections; a round one has no turn
  double point_light_radius = 0;   ///< of every point light, a sphere of even radiance, metres; 0: points
  double sun_angle = 0;       ///< half the angle under which distant lights are seen, radians, below pi / 2; 0: points
  double clamp_indirect = 0;  ///< radiance of a path's brightest channel, at most, of light from one scattering after
                              ///< the first; 0: no limit
};

/// What a path's light is split into: by the number of its scatterings, by where it turned back, and by the lobe of the
/// scattering that the camera sees. Each of the three sums to the whole.
constexpr int k_counts = 6, k_turns = 4, k_max_lobes = 4, k_splits = k_counts + k_turns + k_max_lobes;
/// "scatterings_1", ..., "single", "forward", ..., and the model's lobes.
std::vector<std::string> split_names(const bsdf::Model& model);

/// What the camera sees first along a path.
struct SeenFirst {
  float depth = 0;  ///< along the view, metres
  glm::vec3 tangent{0};
  std::uint32_t strand = 0;  ///< from 1; 0: no fibre
};

struct PathLight {
  glm::dvec3 radiance{0};
  bool covered = false;
  SeenFirst first;
};
using LightSplits = std::array<glm::dvec3, k_splits>;

/// A scene made ready for rays. Safe to use from several threads; a path's light depends on its name and the options
/// alone.
class Tracer {
 public:
  /// Errors: usage, where the model has no sampler; those of RayScene, SurroundingsLight,
  /// TableScattering, VertexTransmittance and DualScattering.
  static Result<std::unique_ptr<Tracer>> make(const TracedScene& scene, const TraceOptions& options);
  ~Tracer();
  /// The light of each path; `paths` and `light` have one size, and `splits` too where layers are asked for.
  void trace(std::span<const PathName> paths, std::span<PathLight> light, std::span<LightSplits> splits = {}) const;
  /// Of the paths that are traced from now on; not while others are.
  void set_seed(std::uint64_t seed);
  const TracedScene& scene() const;
  std::size_t memory_bytes() const;  ///< of the ray tree

 private:
  struct Parts;
  explicit Tracer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace cuticle::render::reference
