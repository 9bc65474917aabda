#include "plan/cost_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include <fmt/core.h>
#include <glm/matrix.hpp>

#include "core/file.h"
#include "core/json/json.h"

namespace cuticle::plan {

namespace {

using Row = std::array<double, 3>;  // 1, pixels, units, each over its largest

/// Least squares over the columns of `used`; empty: they do not determine them.
std::optional<std::array<double, 3>> solve(std::span<const Row> rows, std::span<const double> ms, unsigned used) {
  glm::dmat3 normal(0);
  glm::dvec3 right(0);
  for (int i = 0; i < 3; ++i) {
    if (!(used >> i & 1)) {
      normal[i][i] = 1;
      continue;
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      right[i] += rows[k][std::size_t(i)] * ms[k];
      for (int j = 0; j < 3; ++j)
        if (used >> j & 1) normal[j][i] += rows[k][std::size_t(i)] * rows[k][std::size_t(j)];
    }
  }
  if (!(std::abs(glm::determinant(normal)) > 1e-9)) return std::nullopt;
  const glm::dvec3 found = glm::inverse(normal) * right;
  return std::array{found.x, found.y, found.z};
}

double squares(std::span<const Row> rows, std::span<const double> ms, const std::array<double, 3>& factors) {
  double sum = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double off = factors[0] * rows[k][0] + factors[1] * rows[k][1] + factors[2] * rows[k][2] - ms[k];
    sum += off * off;
  }
  return sum;
}

Json json_of(const PassTime& time) {
  return {{"fixed_ms", time.fixed}, {"ms_per_pixel", time.per_pixel}, {"ms_per_unit", time.per_unit}};
}

CostTable table_of(const Json& json) {
  CostTable table{json.at("device").text(),
                  json.at("driver").text(),
                  json.at("made").text(),
                  {},
                  json.value("most_over_expected", CostTable{}.most_over_expected)};
  for (const auto& [name, time] : json.at("passes").items())
    table.passes[name] = {time.at("fixed_ms").number(), time.at("ms_per_pixel").number(),
                          time.at("ms_per_unit").number()};
  return table;
}

std::string cache_folder() {
  if (const char* own = std::getenv("CUTICLE_CACHE")) return own;
  if (const char* shared = std::getenv("XDG_CACHE_HOME")) return std::string(shared) + "/cuticle";
  const char* home = std::getenv("HOME");
  return std::string(home ? home : ".") + "/.cache/cuticle";
}

}  // namespace

double units_of(const registry::Entry& entry, const registry::FrameShape& shape) {
  if (entry.stage == registry::Stage::simulate) return double(shape.control_vertices) * shape.substeps;
  const std::uint32_t parts = shape.vertices - shape.strands;  // of segments, at whose ends shadow is looked up
  if (entry.kind == registry::EntryKind::method) return double(parts) * shape.lights;
  return shape.vertices;
}

double pixels_of(const scene::Scene& scene) {
  return double(scene.camera.camera.resolution.x) * scene.camera.camera.resolution.y;
}

std::optional<double> predicted_ms(const CostTable& table, const registry::Entry& entry,
                                   const registry::FrameShape& shape, double pixels) {
  const auto found = table.passes.find(entry.name);
  if (found == table.passes.end()) return std::nullopt;
  const PassTime& time = found->second;
  return time.fixed + time.per_pixel * pixels + time.per_unit * units_of(entry, shape);
}

PassTime fit_time(std::span<const TimedPass> measured) {
  double most_pixels = 1, most_units = 1;
  for (const TimedPass& one : measured) {
    most_pixels = std::max(most_pixels, one.pixels);
    most_units = std::max(most_units, one.units);
  }
  std::vector<Row> rows;
  std::vector<double> ms;
  for (const TimedPass& one : measured) {
    rows.push_back({1, one.pixels / most_pixels, one.units / most_units});
    ms.push_back(one.ms);
  }
  // All sets of columns are few: the best without a factor below 0; of equally good ones the later: units before a
  // fixed time before pixels, which grow most from here to a picture's size.
  std::array<double, 3> best{};
  double least = squares(rows, ms, best);
  for (unsigned used : {2u, 1u, 4u, 3u, 6u, 5u, 7u}) {
    const auto found = solve(rows, ms, used);
    if (!found || std::ranges::any_of(*found, [](double factor) { return factor < 0; })) continue;
    if (const double sum = squares(rows, ms, *found); sum <= least + 1e-12) {
      least = sum;
      best = *found;
    }
  }
  return {best[0], best[1] / most_pixels, best[2] / most_units};
}

double upper_bound(std::span<const double> values) {
  constexpr double k_student[] = {6.314, 2.920, 2.353, 2.132, 2.015, 1.943, 1.895, 1.860};  // one-sided 95 %
  const double n = double(values.size());
  double mean = 0, squares = 0;
  for (double value : values) mean += value / n;
  for (double value : values) squares += (value - mean) * (value - mean);
  if (values.size() < 2) return std::numeric_limits<double>::infinity();
  const double t = k_student[std::min(values.size() - 2, std::size(k_student) - 1)];
  return mean + t * std::sqrt(squares / (n - 1) * (1 + 1 / n));
}

double most_of(std::span<const double> ratios) {
  if (ratios.empty()) return 1;
  if (ratios.size() < 2) return std::max(1.0, ratios[0]);
  std::vector<double> logarithms;
  for (double ratio : ratios) logarithms.push_back(std::log(ratio));
  return std::max(1.0, std::exp(upper_bound(logarithms)));
}

std::string cost_table_path(std::string_view device, std::string_view driver) {
  std::string name = fmt::format("{} {}", device, driver);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
  return fmt::format("{}/costs/{}.json", cache_folder(), name);
}

Result<CostTable> read_cost_table(const std::string& path) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  const auto json = Json::parse(text);
  if (!json) return bad_input(fmt::format("{}: {}", path, json.error().message));
  try {
    return table_of(*json);
  } catch (const Json::Mismatch& mismatch) {
    return bad_input(fmt::format("{}: {}", path, mismatch.what()), "calibrate anew: cuticle plan --calibrate");
  }
}

Result<void> write_cost_table(const std::string& path, const CostTable& table) {
  Json passes = Json::object();
  for (const auto& [name, time] : table.passes) passes[name] = json_of(time);
  const Json json = {{"device", table.device},
                     {"driver", table.driver},
                     {"made", table.made},
                     {"most_over_expected", table.most_over_expected},
                     {"passes", passes}};
  std::error_code code;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), code);
  return write_text_file(path, json.dump(1));
}

}  // namespace cuticle::plan
