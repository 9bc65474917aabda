#include <cuticle/bsdf/model.h>

#include <array>
#include <cmath>

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace cuticle::bsdf {
namespace {

constexpr std::array<std::string_view, 5> quantity_names = {"S", "M", "N", "A", "albedo"};

/// A refusal of a name that lists what there is and offers the nearest.
Error unknown_name(std::string_view what, std::string_view name, std::span<const std::string_view> known) {
  const std::string near = registry::nearest_name(name, known);
  return usage_error(fmt::format("{} '{}' is not one of {}", what, name, fmt::join(known, ", ")),
                     near.empty() ? std::string() : fmt::format("did you mean {}?", near));
}

/// A coordinate of Point: which quantities use it, and the largest magnitude that it may have.
struct Coordinate {
  std::string_view name;
  double Point::*member;
  double limit;
  std::string_view limit_words;
  std::array<bool, 5> used;  ///< by S, M, N, A, albedo
};
// A right angle given in degrees may round to just above pi/2.
constexpr double quarter_turn = 1.5707963267948966 * (1 + 1e-12);
constexpr std::array<Coordinate, 5> coordinates = {{
    {"theta_i", &Point::theta_i, quarter_turn, "-pi/2 .. pi/2 rad", {true, true, false, false, false}},
    {"theta_o", &Point::theta_o, quarter_turn, "-pi/2 .. pi/2 rad", {true, true, false, false, true}},
    {"theta_d", &Point::theta_d, quarter_turn, "-pi/2 .. pi/2 rad", {false, false, true, true, false}},
    {"phi", &Point::phi, 1e6, "-1e6 .. 1e6 rad", {true, false, true, false, false}},
    {"h", &Point::h, 1, "-1 .. 1", {false, false, false, true, false}},
}};

Result<void> check_point(Quantity quantity, const Point& point, std::size_t index) {
  for (const Coordinate& coordinate : coordinates) {
    const double value = point.*coordinate.member;
    if (!coordinate.used[std::size_t(quantity)] || std::abs(value) <= coordinate.limit) continue;
    return bad_input(
        fmt::format("point {}: {} = {} is outside {}", index, coordinate.name, value, coordinate.limit_words));
  }
  return {};
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

Result<void> check_request(const Model& model, const Request& request, std::size_t room) {
  CUTICLE_EXPECT(room == request.points.size(), "one result for each point");
  static_cast<void>(room);
  if (request.lobe < -1 || request.lobe >= int(model.lobes.size()))
    return usage_error(
        fmt::format("lobe {} of {} is outside -1 .. {}", request.lobe, model.entry.name, model.lobes.size() - 1));
  for (std::size_t i = 0; i < request.points.size(); ++i)
    CUTICLE_TRY(check_point(request.quantity, request.points[i], i));
  return {};
}

Result<void> evaluate(const Model& model, const registry::ParameterValues& values, Precision precision,
                      const Request& request, std::span<glm::dvec3> out) {
  if (precision == Precision::gpu)
    return usage_error("evaluate runs on the CPU: precision f32 or f64", "use evaluate_gpu");
  CUTICLE_TRY(check_request(model, request, out.size()));
  const auto run = precision == Precision::f32 ? model.evaluate_f32 : model.evaluate_f64;
  const std::size_t grain = request.quantity == Quantity::albedo ? 1 : 256;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, out.size(), grain), [&](const tbb::blocked_range<std::size_t>& range) {
        const Request part{request.quantity, request.lobe, request.points.subspan(range.begin(), range.size())};
        run(values, part, out.subspan(range.begin(), range.size()));
      });
  return {};
}

}  // namespace cuticle::bsdf
