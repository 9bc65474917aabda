#pragma once
// Many paths in step, so that the model is evaluated over arrays.
#include <array>
#include <limits>
#include <optional>

#include "bsdf/batch/batch.h"
#include "render/reference/dual_scattering.h"
#include "render/reference/fibre_point.h"
#include "render/reference/surroundings_light.h"
#include "render/reference/tracer.h"
#include "strands/rays/ray_scene.h"

namespace cuticle::render::reference {

/// What all waves of a scene share.
struct WaveScene {
  const TracedScene* scene = nullptr;
  TraceOptions options;
  std::vector<glm::vec3> tangents, tangents_at_end;
  std::optional<CrossSections> cross_sections;  ///< where phi_o matters
  std::unique_ptr<strands::RayScene> rays;
  std::optional<SurroundingsLight> surroundings;
  std::optional<bsdf::BatchEvaluator> model;
  std::unique_ptr<TableScattering> tables;           ///< in the place of the model's S; null: none
  std::optional<VertexTransmittance> transmittance;  ///< in the place of shadow rays through hair
  std::unique_ptr<strands::RayScene> surfaces;       ///< without hair; where `transmittance` is
  std::optional<DualScattering> dual_scattering;     ///< in the place of light that scatters more than once
  std::optional<CameraRays> camera, camera_at_end;

  Result<void> build(const TracedScene& traced, const TraceOptions& trace_options);
  FibreSegment segment_at(std::uint32_t vertex, double time) const;
  FibrePoint point_of(const strands::RayHit& hit, const glm::dvec3& origin, const glm::dvec3& direction,
                      double time) const;
  /// S; arrays of one size.
  void evaluate(const bsdf::BatchPoints& points, const bsdf::OutputSpans& color) const;
  /// Even surroundings are left to the directions that models draw; dual scattering has none of those.
  bool draws_surroundings() const { return surroundings && (dual_scattering || !surroundings->is_even()); }
};

/// Three arrays of one size.
struct VectorArray {
  std::vector<float> x, y, z;
  void resize(std::size_t size);
  void set(std::size_t at, const glm::vec3& v) { x[at] = v.x, y[at] = v.y, z[at] = v.z; }
  glm::vec3 operator[](std::size_t at) const { return {x[at], y[at], z[at]}; }
  bsdf::VectorSpans in() const { return {x, y, z}; }
  bsdf::OutputSpans out() { return {x, y, z}; }
};

class Wave {
 public:
  explicit Wave(const WaveScene& scene) : scene_(scene) {}
  /// As Tracer::trace.
  void run(std::span<const PathName> names, std::span<PathLight> light, std::span<LightSplits> splits);

 private:
  using Shares = std::array<glm::dvec3, k_max_lobes>;
  struct Path {
    glm::dvec3 origin, direction, throughput{1};
    double time = 0;  ///< of the shutter, 0 .. 1
    strands::FibreLeft from;
    double density = 0;  ///< with which the model drew the direction; 0: nothing was drawn
    int backward = 0;    ///< scatterings that turned back, after the one that the camera sees
  };
  /// Light that arrives at a point if nothing is between.
  struct Arriving {
    glm::dvec3 to_light{0, 1, 0}, irradiance{0};  ///< of one direction drawn by `density`: radiance / density
    double distance = std::numeric_limits<double>::infinity();
    double density = 0;                     ///< 0: the model cannot draw this direction
    glm::dvec3 point{0};                    ///< where it arrives
    std::optional<std::size_t> light = {};  ///< of the scene; none: the surroundings
  };
  struct SurfacePoint {
    std::uint32_t path;
    glm::dvec3 position, normal, albedo;  ///< normal: to the side of the viewer
  };

  void begin_at_camera();
  void end();
  void meet();
  void leave(std::uint32_t path);
  void meet_fibre(std::uint32_t path, const strands::RayHit& hit);
  void meet_surface(std::uint32_t path, const strands::RayHit& hit);
  void light_fibres(int round);
  void scatter_fibres();
  void draw_directions();
  void scatter_surface(const SurfacePoint& point);
  void light_surface(const SurfacePoint& point, int round);
  int light_rounds() const;
  void spread(Arriving& from, const Light& light, std::uint32_t path) const;
  Arriving arriving(const glm::dvec3& point, std::uint32_t path, int round) const;
  glm::dvec3 reaching(std::size_t point, const Arriving& light) const;
  bool is_worth_a_ray(std::uint32_t path, int round, const glm::dvec3& scattered, glm::dvec3& light) const;
  bool goes_on(std::uint32_t path, const glm::dvec3& throughput, double u);
  /// What a split of the light has to know of it.
  struct Way {
    int scatterings;
    int backward;          ///< of them, after the one that the camera sees
    const Shares* shares;  ///< of the lobes there; null: no fibre
  };
  void add(std::uint32_t path, const glm::dvec3& arrived, const Way& way);
  bool turns_back(std::size_t point, const glm::vec3& to_light) const;
  bool splits() const { return scene_.options.layers; }
  const Shares* shares_of(std::uint32_t path) const { return splits() ? &path_shares_[path] : nullptr; }
  std::array<float, 4> numbers(std::uint32_t path, Purpose purpose) const {
    return random_numbers(scene_.options.seed, names_[path], scattering_, purpose);
  }
  /// A light as dual scattering has it at a point.
  struct DualLight {
    glm::dvec3 direct{0};  ///< share that arrives
    MultipleLight multiple;
    int fibres = 0;  ///< on its way, at least
  };
  std::optional<FibresPassed> fibres_before(std::size_t point, const Arriving& light) const;
  DualLight dual_light(std::size_t point, const Arriving& light) const;
  void light_by_dual_scattering(std::size_t point, const Arriving& light, const Shares* shares);
  void find_shares(const VectorArray& to_light, std::vector<Shares>& shares) const;

  const WaveScene& scene_;
  std::span<const PathName> names_;
  std::span<PathLight> light_;
  std::span<LightSplits> splits_;
  std::vector<Path> paths_;
  std::vector<Shares> path_shares_;  ///< of each lobe at the scattering that the camera sees; with splits
  std::vector<std::uint32_t> live_, next_;
  int scattering_ = 0;
  std::vector<SurfacePoint> surface_points_;
  std::vector<std::uint32_t> fibre_paths_;  ///< of the points below
  std::vector<FibrePoint> fibre_points_;
  VectorArray to_viewer_, to_light_, value_;
  std::vector<float> h_, density_;
  std::array<std::vector<float>, 7> u_;
  std::vector<float> ending_;
  std::vector<Shares> shares_;
};

}  // namespace cuticle::render::reference
