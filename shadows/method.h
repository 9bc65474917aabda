#pragma once
// The concept of a shadow method: transmittance of light from outside the hair to points inside it.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/registry/entry.h"
#include "core/result.h"
#include "shadows/light_frame.h"
#include "strands/groom.h"

namespace cuticle::shadows {

/// What casts: strands as cylinders of their radii, each crossing taking away `alpha` of the light.
struct Casters {
  const strands::Groom* groom = nullptr;
  double alpha = 0.4;                          ///< opacity of one fibre crossing, 0 .. 1
  glm::dvec3 to_light{0, 1, 0};                ///< unit, from the scene to the light
  std::optional<glm::dvec3> point_light = {};  ///< a light at this place, metres, instead

  LightSource light() const { return {to_light, point_light}; }
};
/// The light's view of the casters. Errors: those of light_axes.
Result<LightAxes> axes_of(const Casters& casters);

/// The segment that a point lies on: its ends, metres, and how far from the first to the second the point lies, 0 .. 1.
struct SegmentPlace {
  glm::vec3 from{0}, to{0};
  float fraction = 0;
};
/// Where transmittance is asked for. A point that lies on a strand says which, so that the fibre does not shadow itself
/// there (docs/conventions.md).
struct Receivers {
  std::span<const glm::vec3> points;
  std::span<const std::uint32_t> strands = {};   ///< one per point, or empty
  std::span<const SegmentPlace> segments = {};   ///< one per point, or empty: every point is a vertex
  std::span<const std::uint32_t> vertices = {};  ///< of the groom: the point's, or the first of its segment; or empty
  /// Of points on strands, which lie on the fibres' axes: the viewer, metres, who sees their surface. None: the axes.
  std::optional<glm::dvec3> seen_from = {};
  /// Where the viewer's rays met the fibres' surfaces, metres: `truth` starts there. One per point, or empty: the
  /// middle of the side that is seen, which is what methods look up.
  std::span<const glm::vec3> met = {};
  /// Of the fibres that a point's strand stands for, as a share of the strand's width, 0 .. 1: what is left out is what
  /// lies within such a fibre, not what lies within the strand (docs/conventions.md). `truth` knows strands alone.
  double fibre_width = 1;
};

struct Cost {
  double build_ms = 0, lookup_ms = 0;  ///< wall clock
  std::size_t bytes = 0;               ///< of the structure that is looked up
  std::string device;                  ///< "cpu (N threads)" or a GPU's name
};

/// Transmittance in [0, 1], one per receiver, with the noise of the estimate (0 for deterministic methods).
struct Transmittance {
  std::vector<float> values;
  std::vector<float> standard_error;  ///< empty unless the method is stochastic
  std::vector<float> occluders;  ///< of `truth`: metres to the nearest other fibre that a ray meets; infinity: none
  std::size_t clamped = 0;       ///< numbers of the structure that the range of their format cut off
  Cost cost;
};

struct Method {
  registry::Entry entry;
  Result<Transmittance> (*evaluate)(const Casters&, const Receivers&, const registry::ParameterValues&);
  /// Whether T = exp(-alpha tau) with a tau that no alpha changes, but for the rounding of sums, within 6e-4 of T
  /// (methods_test: OfAProportionalMethod); null: no.
  bool (*is_proportional)(const registry::ParameterValues&) = nullptr;
};
std::span<const Method* const> methods();
/// Error: usage, with the nearest known name.
Result<const Method*> find_method(std::string_view name);

/// What every method refuses: a zero or non-finite light, and one too far away, alpha outside 0 .. 1 (usage); a groom
/// or points that are not sound (bad_input, naming the field or the point).
Result<void> check(const Casters& casters, const Receivers& receivers);

/// "cpu (N threads)": the threads that work in this call may use.
std::string cpu_device_name();

}  // namespace cuticle::shadows
