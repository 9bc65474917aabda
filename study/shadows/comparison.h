#pragma once
// Shadow methods against ray-traced truth on one groom and light: error, time, memory.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/progress.h"
#include "core/registry/parameter.h"
#include "core/result.h"
#include "shadows/method.h"
#include "strands/groom.h"
#include "study/shadows/flicker.h"
#include "study/shadows/probes.h"

namespace cuticle::study {

/// Settings that several methods have, under names of their own: each method takes those that it has a parameter for.
/// A parameter of one method, as text.
struct MethodSetting {
  std::string method, parameter, value;
};
/// Of METHOD.NAME=VALUE each. Error: usage, for a text that is none.
Result<std::vector<MethodSetting>> parse_method_settings(const std::vector<std::string>& texts);

struct Sweep {
  std::vector<std::int64_t> layers;          ///< "slices" or "layers"; empty: the method's default
  std::vector<std::int64_t> resolutions;     ///< "resolution"
  std::vector<double> filter_radii;          ///< metres, "filter_radius_mm"; empty: the method's default
  std::vector<std::string> spacings;         ///< "spacing"; empty: the method's default
  bool skip_unfit = false;                   ///< a method that takes none of the numbers is left out, not refused
  std::vector<double> filter_texels = {};    ///< "filter_texels"; empty: the method's default
  std::vector<MethodSetting> settings = {};  ///< of every candidate of their methods, where nothing above sets the same
};
/// Each method with every combination of settings that it knows. A method without slices or layers comes in each of its
/// registered study cases instead, where layers are swept. Error: usage, for an unknown method or a value out of range,
/// and for a setting of a method that is not among them or lacks the parameter.
Result<std::vector<Candidate>> candidates_of(std::span<const std::string> methods, const Sweep& sweep);
/// Numbers of the sweep that a method with others of them does not take, a sentence each: "deep_opacity: layers 64
/// left out, it takes 1 .. 16".
std::vector<std::string> left_out_of(std::span<const std::string> methods, const Sweep& sweep);
/// Names of all methods of this build but truth.
std::vector<std::string> all_methods();
/// What differs from the defaults, as `--set` would take it.
std::string settings_text(const Candidate& candidate);

/// What is compared, where, and how exact the truth is.
struct ComparisonRequest {
  std::string name = "shadows", title = "Shadow methods against ray-traced truth";
  std::string groom_name;
  const strands::Groom* groom = nullptr;
  double alpha = 0.4;              ///< opacity of one crossing, 0 .. 1
  glm::dvec3 to_light{1, 1, 0.3};  ///< made unit
  /// Metres; 0: shadows::default_footprint_radius, and of what a camera sees the point alone, from which one ray
  /// starts.
  double footprint_radius = 0;
  int rays = 1024;                         ///< of the truth, per receiver
  std::size_t receivers = 1000;            ///< spread evenly; all if there are fewer
  Weights weights = Weights::at_vertices;  ///< else receivers are the middles of segments
  std::optional<glm::dvec3> to_camera;     ///< receivers are what a camera in this direction sees instead
  bool flicker = false;                    ///< measured as well, by two more evaluations of each setting
  std::vector<Candidate> candidates;
};

/// Receivers are halved, so that settings are chosen on one half and their errors reported on the other.
enum class Half { choosing, reporting, both };

/// Receivers that errors are counted at: those with 0.05 < truth < 0.95, which a wide disc gives most of those in hair;
/// or all, for what a camera sees: behind opaque fibres a pixel's truth is mostly 0 or 1.
enum class Counted { partly_lit, all };
constexpr bool is_counted(float truth, Counted counted) {
  return counted == Counted::all || (truth > 0.05f && truth < 0.95f);
}

/// Of |T - truth| over the receivers counted; bias is the mean of T - truth. Intervals: half widths that hold 95 %.
struct ErrorStatistics {
  double mean = 0, percentile_95 = 0, maximum = 0, bias = 0;
  double mean_interval = 0, bias_interval = 0;
};
/// Milliseconds on a device, for all vertices: of a submission by wall clock, and of its passes by timestamps.
struct DeviceCost {
  std::string device;
  double wall_ms = 0, build_ms = 0, lookup_ms = 0;
  std::vector<std::pair<std::string, double>> passes;  ///< name and milliseconds of each, in their order
};
/// The mean error of the receivers whose nearest occluder lies from .. to metres away.
struct ContactError {
  double from = 0, to = 0;
  std::size_t receivers = 0;
  ErrorStatistics error;
};
struct ComparisonRow {
  std::string method, settings;  ///< settings as `--set` would take them: what differs from the defaults
  registry::ParameterValues values;
  ErrorStatistics choosing, error;  ///< over either half; `error` is the one to report
  shadows::Cost cost;               ///< lookup at the receivers
  double total_ms = 0;              ///< build, and lookup at every vertex of the groom
  double light_left = 1;            ///< mean T of all receivers, whatever their truth
  double light_left_interval = 0;   ///< half width of 95 % of its difference to the truth's
  std::vector<ContactError> contact;
  std::vector<float> transmittance;  ///< at the receivers
  std::optional<Flicker> flicker;
  std::optional<DeviceCost> on_device;
};
/// A setting that its method did not take, and why.
struct Refusal {
  std::string method, settings, why;
};
struct Comparison {
  std::string name, title, groom_name;
  std::size_t strands = 0, vertices = 0;
  double alpha = 0, spacing = 0, footprint_radius = 0;  ///< metres
  glm::dvec3 to_light{0, 1, 0};
  int rays = 0;
  bool at_pixels = false;                  ///< receivers are what a camera sees
  std::size_t receivers = 0, counted = 0;  ///< asked for, and of those that errors are of
  Counted errors_of() const { return at_pixels ? Counted::all : Counted::partly_lit; }
  double truth_standard_error = 0;  ///< mean over the receivers counted
  shadows::Cost truth_cost;
  double light_left = 1;                ///< the truth's, of all receivers
  ErrorStatistics none, best_constant;  ///< baselines: T = 1, and the constant with the least mean |error| (the median)
  double best_constant_value = 0;
  std::vector<glm::vec3> points;  ///< of the receivers, with their true transmittance and its standard error
  std::vector<float> truth, truth_errors;
  std::vector<float> occluders;  ///< metres to the nearest fibre between a receiver and the light; infinity: none
  std::vector<ComparisonRow> rows;
  std::vector<Refusal> refused;
};

/// Runs the truth once and every candidate. Error: usage where this build has no truth (no Embree), or where every
/// candidate is refused; bad_input where a half has no receiver with 0.05 < truth < 0.95.
Result<Comparison> compare_with_truth(const ComparisonRequest& request, Progress& progress);

/// Statistics of values against the truth over the receivers of a half that are counted.
ErrorStatistics error_statistics(std::span<const float> values, std::span<const float> truth, Half half = Half::both,
                                 Counted counted = Counted::partly_lit);

/// Errors by distance to the nearest occluder, of both halves: bands that double from half a millimetre, the first from
/// 0, the last without end; those without a receiver are left out.
std::vector<ContactError> contact_errors(std::span<const float> values, const Comparison& comparison);

/// What a setting must keep; 0: not asked for.
struct Request {
  double max_error = 0;  ///< mean error, on both halves
  double budget_ms = 0;  ///< build, and lookup at every vertex
};
/// The row to take within the request: the least time where an error is given, else the least error on the choosing
/// half. Null: none meets it.
const ComparisonRow* best_choice(const Comparison& comparison, const Request& request);
/// The row that passes the request by the smallest factor, and the words why it fails. `comparison` has rows.
struct Nearest {
  const ComparisonRow* row = nullptr;
  std::string because;
};
Nearest nearest_to(const Comparison& comparison, const Request& request);

/// study/README.md describes both.
std::string to_json(const Comparison& comparison);
std::string to_csv(const Comparison& comparison);
/// ComparisonRow::contact of every row: method, settings, from_mm, to_mm, receivers, mean_error, mean_interval, bias.
std::string contact_csv(const Comparison& comparison);
/// Receivers with their truth, and the transmittance of each method's best setting on the choosing half: x,y,z,truth,
/// standard_error, then one column a method.
std::string receivers_csv(const Comparison& comparison);
/// Writes study.json, study.csv, contact.csv and receivers.csv into the folder.
Result<void> write_comparison(const Comparison& comparison, const std::string& folder);

}  // namespace cuticle::study
