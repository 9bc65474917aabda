#pragma once
// Shadow methods against ray-traced truth on one groom and light: error, time, memory.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include <cuticle/core/progress.h>
#include <cuticle/core/registry/parameter.h>
#include <cuticle/core/result.h>
#include <cuticle/shadows/method.h>
#include <cuticle/strands/groom.h>

namespace cuticle::study {

/// A method with its parameters, as one point of the comparison.
struct Candidate {
  const shadows::Method* method = nullptr;
  registry::ParameterValues values;
};

/// Settings that several methods have, under names of their own: each method takes those that it has a parameter for.
struct Sweep {
  std::vector<std::int64_t> layers;       ///< "slices" or "layers"; empty: the method's default
  std::vector<std::int64_t> resolutions;  ///< "resolution"
  double filter_radius = 0;               ///< metres, "filter_radius_mm"; 0: the method's default
};
/// Each method with every layers x resolution that it knows. Error: usage, for an unknown method or a value out of range.
Result<std::vector<Candidate>> candidates_of(std::span<const std::string> methods, const Sweep& sweep);
/// What differs from the defaults, as `--set` would take it.
std::string settings_text(const Candidate& candidate);

/// What is compared, where, and how exact the truth is.
struct ComparisonRequest {
  std::string name = "shadows", title = "Shadow methods against ray-traced truth";
  std::string groom_name;
  const strands::Groom* groom = nullptr;
  double alpha = 0.4;                     ///< opacity of one crossing, 0 .. 1
  glm::dvec3 to_light{1, 1, 0.3};         ///< made unit
  double footprint_radius = 0;            ///< metres; 0 = shadows::default_footprint_radius
  int rays = 1024;                        ///< of the truth, per receiver
  std::size_t receivers = 1000;           ///< strand vertices, spread evenly; all if there are fewer
  std::vector<Candidate> candidates;
};

/// Of |T - truth| over the receivers counted; bias is the mean of T - truth.
struct ErrorStatistics {
  double mean = 0, percentile_95 = 0, maximum = 0, bias = 0;
};
struct ComparisonRow {
  std::string method, settings;           ///< settings as `--set` would take them: what differs from the defaults
  registry::ParameterValues values;
  ErrorStatistics error;
  shadows::Cost cost;
};
struct Comparison {
  std::string name, title, groom_name;
  std::size_t strands = 0, vertices = 0;
  double alpha = 0, spacing = 0, footprint_radius = 0;   ///< metres
  glm::dvec3 to_light{0, 1, 0};
  int rays = 0;
  std::size_t receivers = 0, counted = 0;  ///< asked for, and of those with 0.05 < truth < 0.95
  double truth_standard_error = 0;         ///< mean over the receivers counted
  shadows::Cost truth_cost;
  ErrorStatistics none, best_constant;     ///< baselines: T = 1, and the constant with the least mean |error| (the median)
  double best_constant_value = 0;
  std::vector<ComparisonRow> rows;
};

/// Runs the truth once and every candidate. Error: usage where this build has no truth (no Embree), or what a method refuses;
/// bad_input where no receiver has 0.05 < truth < 0.95.
Result<Comparison> compare_with_truth(const ComparisonRequest& request, Progress& progress);

/// Vertices that stand for the groom: `count` of them, spread evenly over the list, with their strands.
struct Probes {
  std::vector<glm::vec3> points;
  std::vector<std::uint32_t> strands;
};
Probes spread_probes(const strands::Groom& groom, std::size_t count);

/// Statistics of values against the truth over the receivers with 0.05 < truth < 0.95.
ErrorStatistics error_statistics(std::span<const float> values, std::span<const float> truth);

/// The row to take within the limits (mean error, build + lookup time), of which one that is 0 does not count: the least time
/// where an error is given, else the least error. Null: none meets them.
const ComparisonRow* best_choice(const Comparison& comparison, double max_error, double budget_ms);

/// study/README.md describes both.
std::string to_json(const Comparison& comparison);
std::string to_csv(const Comparison& comparison);
/// Writes study.json and study.csv into the folder.
Result<void> write_comparison(const Comparison& comparison, const std::string& folder);

}  // namespace cuticle::study
