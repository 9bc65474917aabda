#include "bsdf/model.h"

#include <array>
#include <atomic>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace cuticle::bsdf {
namespace {

constexpr std::array<std::string_view, quantity_count> quantity_names = {"S", "M", "N", "A", "albedo", "pdf", "error"};

/// A refusal of a name that lists what there is and offers the nearest.
Error unknown_name(std::string_view what, std::string_view name, std::span<const std::string_view> known) {
  const std::string near = registry::nearest_name(name, known);
  return usage_error(fmt::format("{} '{}' is not one of {}", what, name, fmt::join(known, ", ")),
                     near.empty() ? std::string() : fmt::format("did you mean {}?", near));
}

/// A coordinate of Point: the quantities that are functions of it, in the far field and in the near field, and the
/// largest magnitude that it may have.
struct Coordinate {
  std::string_view name;
  double Point::*member;
  double limit;
  std::string_view limit_words;
  std::string_view far, near;  ///< a letter for each quantity: S, M, N, A, a(lbedo), p(df), e(rror)
};
constexpr std::string_view quantity_letters = "SMNAape";
// A right angle given in degrees may round to just above pi/2.
constexpr double quarter_turn = 1.5707963267948966 * (1 + 1e-12);
constexpr std::array<Coordinate, coordinate_count> coordinates = {{
    {"theta_i", &Point::theta_i, quarter_turn, "-pi/2 .. pi/2 rad", "SMpe", "SMpe"},
    {"theta_o", &Point::theta_o, quarter_turn, "-pi/2 .. pi/2 rad", "SMape", "SMape"},
    {"theta_d", &Point::theta_d, quarter_turn, "-pi/2 .. pi/2 rad", "NA", "NA"},
    {"phi", &Point::phi, 1e6, "-1e6 .. 1e6 rad", "SNpe", "SNpe"},
    {"h", &Point::h, 1, "-1 .. 1", "A", "SNAape"},
    {"phi_o", &Point::phi_o, 1e6, "-1e6 .. 1e6 rad", "", ""},
}};

bool in_list(std::string_view letters, Quantity quantity) {
  return letters.find(quantity_letters[std::size_t(quantity)]) != std::string_view::npos;
}

Result<void> check_magnitude(const Coordinate& coordinate, double value, std::string_view what, std::size_t index) {
  if (std::abs(value) <= coordinate.limit) return {};
  return bad_input(
      fmt::format("{} {}: {} = {} is outside {}", what, index, coordinate.name, value, coordinate.limit_words));
}

Result<void> check_point(Quantity quantity, const Point& point, std::size_t index) {
  for (const Coordinate& coordinate : coordinates)
    if (in_list(coordinate.near, quantity) || coordinate.member == &Point::phi_o)
      CUTICLE_TRY(check_magnitude(coordinate, point.*coordinate.member, "point", index));
  return {};
}

Result<void> check_query(const SampleQuery& query, std::size_t index) {
  CUTICLE_TRY(check_magnitude(coordinates[1], query.theta_o, "query", index));
  CUTICLE_TRY(check_magnitude(coordinates[4], query.h, "query", index));
  CUTICLE_TRY(check_magnitude(coordinates[5], query.phi_o, "query", index));
  for (double u : query.u)
    if (!(u >= 0 && u < 1)) return bad_input(fmt::format("query {}: u = {} is outside [0, 1)", index, u));
  return {};
}

Result<void> check_lobe(const Model& model, int lobe) {
  if (lobe >= -1 && lobe < int(model.lobes.size())) return {};
  return usage_error(fmt::format("lobe {} of {} is outside -1 .. {}", lobe, model.entry.name, model.lobes.size() - 1));
}

Result<void> check_interval(const AzimuthInterval& interval, std::size_t index) {
  CUTICLE_TRY(check_magnitude(coordinates[2], interval.theta_d, "interval", index));
  if (interval.begin >= 0 && interval.begin < interval.end && interval.end <= std::numbers::pi) return {};
  return bad_input(
      fmt::format("interval {}: {} .. {} does not rise within 0 .. pi", index, interval.begin, interval.end));
}

/// As blocks of consecutive items on all threads.
template <class Body>
void in_parallel(std::size_t count, std::size_t grain, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.size()); });
}

}  // namespace

Result<const Model*> find_model(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Model* model : models()) {
    if (model->entry.name == name) return model;
    known.push_back(model->entry.name);
  }
  return unknown_name("model", name, known);
}

Result<int> find_lobe(const Model& model, std::string_view lobe) {
  if (lobe == "sum") return -1;
  std::vector<std::string_view> known(model.lobes.begin(), model.lobes.end());
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i] == lobe) return int(i);
  known.push_back("sum");
  return unknown_name(fmt::format("lobe of {}", model.entry.name), lobe, known);
}

Result<Quantity> find_quantity(std::string_view name) {
  for (std::size_t i = 0; i < quantity_names.size(); ++i)
    if (quantity_names[i] == name) return Quantity(i);
  return unknown_name("quantity", name, quantity_names);
}

Result<registry::ParameterValues> parse_settings(const Model& model, std::string_view preset,
                                                 std::string_view settings) {
  if (preset.empty()) return registry::parse_assignments(model.entry.parameters, settings);
  std::vector<std::string_view> known;
  for (const registry::StudyCase& candidate : model.presets) {
    if (candidate.name == preset)
      return registry::parse_assignments(model.entry.parameters, fmt::format("{},{}", candidate.settings, settings));
    known.push_back(candidate.name);
  }
  return unknown_name(fmt::format("preset of {}", model.entry.name), preset, known);
}

std::array<bool, coordinate_count> coordinates_of(const Model& model, const registry::ParameterValues& values,
                                                  Quantity quantity) {
  const bool near = model.near_field && model.near_field(values);
  std::array<bool, coordinate_count> used{};
  for (std::size_t c = 0; c < coordinate_count; ++c)
    used[c] = in_list(near ? coordinates[c].near : coordinates[c].far, quantity);
  return used;
}

Result<void> check_request(const Model& model, const Request& request, std::size_t room) {
  CUTICLE_EXPECT(room == request.points.size(), "one result for each point");
  static_cast<void>(room);
  CUTICLE_TRY(check_lobe(model, request.lobe));
  for (std::size_t i = 0; i < request.points.size(); ++i)
    CUTICLE_TRY(check_point(request.quantity, request.points[i], i));
  return {};
}

Result<void> check_queries(std::span<const SampleQuery> queries, std::size_t room) {
  CUTICLE_EXPECT(room == queries.size(), "one sample for each query");
  static_cast<void>(room);
  for (std::size_t i = 0; i < queries.size(); ++i) CUTICLE_TRY(check_query(queries[i], i));
  return {};
}

Result<void> evaluate(const Model& model, const registry::ParameterValues& values, Precision precision,
                      const Request& request, std::span<glm::dvec3> out) {
  if (precision == Precision::gpu)
    return usage_error("evaluate runs on the CPU: precision f32 or f64", "use evaluate_gpu");
  CUTICLE_TRY(check_request(model, request, out.size()));
  const auto run = precision == Precision::f32 ? model.evaluate_f32 : model.evaluate_f64;
  const std::size_t grain = request.quantity == Quantity::albedo ? 1 : 256;
  in_parallel(out.size(), grain, [&](std::size_t first, std::size_t count) {
    run(values, {request.quantity, request.lobe, request.points.subspan(first, count)}, out.subspan(first, count));
  });
  return {};
}

namespace {

bool shares_viewer(const Point& a, const Point& b) {
  return a.theta_o == b.theta_o && a.phi_o == b.phi_o && a.h == b.h;
}

/// Where runs of points of one viewer begin, and the end of all. Long ones are divided among threads, each of which
/// does the viewer's work anew.
std::vector<std::size_t> runs_of_viewers(std::span<const Point> points) {
  constexpr std::size_t longest = 512;
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i == 0 || i - begins.back() == longest || !shares_viewer(points[i - 1], points[i])) begins.push_back(i);
  begins.push_back(points.size());
  return begins;
}

}  // namespace

Result<bool> scattering_from_viewers(const Model& model, const registry::ParameterValues& values, int effort, int lobe,
                                     std::span<const Point> points, std::span<glm::dvec3> out) {
  CUTICLE_EXPECT(effort >= 1, "some work is done");
  if (!model.scattering_from_viewer) return false;
  CUTICLE_TRY(check_request(model, {Quantity::S, lobe, points}, out.size()));
  const std::vector<std::size_t> begins = runs_of_viewers(points);
  in_parallel(begins.size() - 1, 1, [&](std::size_t first, std::size_t count) {
    for (std::size_t run = first; run < first + count; ++run) {
      const std::size_t size = begins[run + 1] - begins[run];
      model.scattering_from_viewer(values, effort, lobe, points.subspan(begins[run], size),
                                   out.subspan(begins[run], size));
    }
  });
  return true;
}

Result<bool> azimuthal_means(const Model& model, const registry::ParameterValues& values, int lobe,
                             std::span<const AzimuthInterval> intervals, std::span<AzimuthMean> out) {
  if (!model.azimuthal_means) return false;
  CUTICLE_TRY(check_lobe(model, lobe));
  for (std::size_t i = 0; i < intervals.size(); ++i) CUTICLE_TRY(check_interval(intervals[i], i));
  std::atomic<bool> all = true;
  in_parallel(out.size(), 1024, [&](std::size_t first, std::size_t count) {
    if (!model.azimuthal_means(values, lobe, intervals.subspan(first, count), out.subspan(first, count))) all = false;
  });
  return all.load();
}

Result<void> sample(const Model& model, const registry::ParameterValues& values, Precision precision,
                    std::span<const SampleQuery> queries, std::span<Sample> out) {
  if (precision == Precision::gpu)
    return usage_error("sample runs on the CPU: precision f32 or f64", "GpuEvaluator::sample");
  const auto run = precision == Precision::f32 ? model.sample_f32 : model.sample_f64;
  if (!run) return usage_error(fmt::format("model {} has no sampler", model.entry.name));
  CUTICLE_TRY(check_queries(queries, out.size()));
  in_parallel(out.size(), 256, [&](std::size_t first, std::size_t count) {
    run(values, queries.subspan(first, count), out.subspan(first, count));
  });
  return {};
}

}  // namespace cuticle::bsdf
