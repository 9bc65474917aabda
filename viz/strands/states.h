#pragma once
// A view of strand states: a run of a simulation, or a groom, coloured by a number per vertex. Needs no VTK.
#include <optional>
#include <string>
#include <vector>

#include "core/view.h"
#include "strands/groom.h"
#include "strands/mesh.h"
#include "viz/color/ramp.h"
#include "viz/strands/collider_file.h"

namespace cuticle::viz {

/// The frames of a run in their order, or one state.
struct RunFrame {
  double time = 0;  ///< seconds
  std::string file;
};
struct Run {
  std::string name;
  std::vector<RunFrame> frames;
  RunColliders colliders = {};  ///< of the colliders.json beside the states
  /// Colliders where they stand in a frame, and the head there (rest -> world).
  std::vector<sim::PlacedCollider> colliders_at(int frame) const;
  glm::dmat4 head_at(int frame) const;
};
/// A folder with states.pvd, a .pvd, or one file of strands (any that the toolkit reads). Error: bad_input naming it.
Result<Run> find_run(const std::string& path);
/// The place of the state of this number (of state_0060.vtp, 60) among a run's frames. Error: usage, naming first and
/// last.
Result<int> frame_at(const Run& run, int number);
/// One state, metres; its arrays are attributes.
Result<strands::Groom> read_frame(const Run& run, int frame, double metres_per_unit);

/// What strands are coloured by, and what that needs to know.
struct StrandColoring {
  /// arc_length, curvature, twist, speed, strand, level, asleep, contact, transmittance, error:METHOD, or an array of
  /// the file (stretch, tension, guard_fired, ..: "velocity" is its length); empty: stretch, or arc_length where the
  /// file has none.
  std::string name;
  glm::dvec3 to_light{0.5, 1, 0.6};    ///< of transmittance and error
  double alpha = 0.4;                  ///< opacity of a fibre crossing, of the same
  std::vector<Sphere> colliders = {};  ///< of contact, world space, metres
};
struct ColoredStrands {
  std::vector<float> values;  ///< one per vertex
  std::string title;          ///< with its unit
  bool diverging = false;
  double neutral = 0;                ///< of diverging colours
  std::optional<double> reach = {};  ///< the most that the scale goes to either side of it
};
/// `before`: the state a frame earlier, for asleep (strands that stand bit by bit where they stood). Error: usage,
/// listing what the file has, for an unknown name; those of the shadow methods.
Result<ColoredStrands> color_strands(const strands::Groom& groom, const StrandColoring& coloring,
                                     const strands::Groom* before = nullptr);
ColorScale scale_of(const ColoredStrands& colored);

struct StrandsView {
  std::vector<Run> runs;  ///< one, or two under one camera
  int frame = 0;          ///< its place in the run
  double metres_per_unit = 0;
  StrandColoring coloring;
  std::optional<std::size_t> strand;       ///< whose curves are drawn; none: that of the largest value
  std::optional<strands::Mesh> mesh = {};  ///< the growth mesh at rest, metres; the head carries it
  double density_cell = 0;                 ///< metres; 0: no density is drawn
};

/// Writes the shown frame of every run as strands_NAME.vtp with the colours' numbers, its colliders as
/// colliders_NAME.vtp and field_NAME_K.vti, hair's density as density_NAME.vti, a .pvd over the files of its whole run,
/// and a state for ParaView that opens it coloured (paraview_NAME.py). Error: bad_input naming the file.
Result<void> write_strands(const StrandsView& view, const std::string& folder);

/// Length along the strand from its root, metres, one per vertex.
std::vector<float> arc_lengths(const strands::Groom& groom);

}  // namespace cuticle::viz
