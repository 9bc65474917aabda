#include "viz/shadow/shadow.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/file.h"
#include "shadows/deep_opacity/deep_map.h"
#include "shadows/opacity_map/map.h"
#include "viz/files/vtk_xml.h"

namespace cuticle::viz {
namespace {

shadows::Casters casters_of(const ShadowView& view) { return {&view.groom, view.alpha, glm::normalize(view.to_light)}; }

std::string settings_of(const ShadowView& view, const shadows::Method& method) {
  const std::string_view name = method.entry.name;
  if (name == "truth") return fmt::format("rays={}", view.truth_rays);
  std::string text;
  const auto set = [&](std::string_view parameter, int value) {
    const auto found = registry::find_parameter(method.entry.parameters, parameter);
    if (found)
      text += fmt::format("{}{}={}", text.empty() ? "" : ",", parameter,
                          std::clamp(double(value), (*found)->minimum, (*found)->maximum));
  };
  set("layers", view.layers);
  set("slices", view.layers);
  if (name != "voxel") set("resolution", view.resolution);
  return text;
}

Result<std::vector<float>> transmittance_at(const ShadowView& view, std::string_view name,
                                            std::span<const glm::vec3> points) {
  CUTICLE_ASSIGN(const shadows::Method* method, shadows::find_method(name));
  CUTICLE_ASSIGN(const auto values, registry::parse_assignments(method->entry.parameters, settings_of(view, *method)));
  CUTICLE_ASSIGN(shadows::Transmittance found, method->evaluate(casters_of(view), {points}, values));
  return std::move(found.values);
}

double depth_of(float transmittance) {
  return transmittance > 0 ? std::min(-std::log(double(transmittance)), k_max_depth) : k_max_depth;
}

/// A place of a map as a world point: the inverse of to_map of a distant light.
glm::vec3 world_of(const shadows::MapView& map, const glm::vec3& place) {
  const glm::vec3 seen = (place - map.offset) / map.scale - map.axes.origin;
  return map.axes.right * seen.x + map.axes.up * seen.y + map.axes.forward * seen.z;
}

/// Corners of a sheet at every `step` texels.
template <class Depth>
Sheet make_sheet(const shadows::MapView& map, std::uint32_t step, const Depth& depth_at) {
  Sheet sheet;
  for (std::uint32_t y = 0; y < map.rows; y += step, ++sheet.rows) {
    sheet.columns = 0;
    for (std::uint32_t x = 0; x < map.columns; x += step, ++sheet.columns) {
      const std::size_t texel = std::size_t(y) * map.columns + x;
      const auto [z, depth, is_hair] = depth_at(texel);
      sheet.positions.push_back(world_of(map, {float(x) + 0.5F, float(y) + 0.5F, z}));
      sheet.depths.push_back(depth);
      sheet.is_hair.push_back(is_hair);
    }
  }
  return sheet;
}

struct AtTexel {
  float z = 0, depth = 0;
  std::uint8_t is_hair = 0;
};

std::uint32_t step_for(const shadows::MapView& map, int most_columns) {
  return std::max<std::uint32_t>(1, std::max(map.columns, map.rows) / std::uint32_t(std::max(2, most_columns)));
}

}  // namespace

Result<std::vector<Sheet>> opacity_sheets(const ShadowView& view, int most_columns) {
  CUTICLE_ASSIGN(const shadows::LightAxes axes, shadows::axes_of(casters_of(view)));
  shadows::opacity_map::Settings settings;
  settings.slices = std::uint32_t(std::clamp(view.layers + 1, 2, 256));
  settings.map.resolution = std::uint32_t(view.resolution);
  const auto map = shadows::opacity_map::build_map(view.groom, view.alpha, axes, settings);
  const std::uint32_t step = step_for(map.view, most_columns);
  std::vector<Sheet> sheets;
  for (std::uint32_t layer = 0; layer < map.layers; ++layer)
    sheets.push_back(make_sheet(map.view, step, [&](std::size_t texel) {
      const auto sigma = [&](std::uint32_t k) { return double(map.sums[texel * map.layers + k]) / map.scale; };
      const double k = settings.map.accumulation.k;
      return AtTexel{float(layer + 1), float(k * sigma(layer)), sigma(map.layers - 1) > 0};
    }));
  return sheets;
}

Result<std::vector<Sheet>> deep_opacity_sheets(const ShadowView& view, int most_columns) {
  namespace deep = shadows::deep_opacity;
  CUTICLE_ASSIGN(const shadows::LightAxes axes, shadows::axes_of(casters_of(view)));
  deep::Settings settings;
  settings.layers = std::uint32_t(std::clamp(view.layers, 1, 16));
  settings.map.resolution = std::uint32_t(view.resolution);
  settings.spacing = deep::Spacing::equal;
  const deep::Map map = deep::build_map(view.groom, view.alpha, axes, settings);
  const std::uint32_t step = step_for(map.view, most_columns);
  std::vector<Sheet> sheets;
  for (std::uint32_t layer = 0; layer < settings.layers; ++layer)
    sheets.push_back(make_sheet(map.view, step, [&](std::size_t texel) {
      const std::uint32_t range = map.ranges[texel];
      if (range == deep::k_no_range) return AtTexel{};
      const float extent = deep::depth_extent<float>(range);
      const float end = std::min(float(map.ends.end[layer]) / deep::layer_scale(extent, map.by_texel), extent);
      const double sigma = double(map.sums[texel * settings.layers + layer]) / map.scale;
      return AtTexel{float(deep::range_nearest(range)) + end, float(settings.map.accumulation.k * sigma), 1};
    }));
  return sheets;
}

Result<TransmittanceVolume> transmittance_volume(const ShadowView& view, int cells) {
  const strands::Bounds box = strands::bounds(view.groom);
  const glm::dvec3 lower(box.lower), extent = glm::dvec3(box.upper) - lower;
  TransmittanceVolume volume;
  const double step = std::max({extent.x, extent.y, extent.z, 1e-6}) / cells;
  volume.spacing = glm::dvec3(step);
  volume.origin = lower;
  for (int axis = 0; axis < 3; ++axis) volume.size[axis] = std::max(2, int(std::ceil(extent[axis] / step)) + 1);
  std::vector<glm::vec3> points;
  for (int z = 0; z < volume.size.z; ++z)
    for (int y = 0; y < volume.size.y; ++y)
      for (int x = 0; x < volume.size.x; ++x) points.emplace_back(lower + step * glm::dvec3(x, y, z));
  CUTICLE_ASSIGN(volume.values, transmittance_at(view, "deep_opacity", points));
  return volume;
}

LightRay light_ray(const ShadowView& view) {
  const strands::Bounds box = strands::bounds(view.groom);
  const glm::dvec3 lower(box.lower), upper(box.upper), to_light = glm::normalize(view.to_light);
  const glm::dvec3 middle = view.through.value_or((lower + upper) / 2.0);
  double near = -1e9, far = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(to_light[axis]) < 1e-9) continue;
    const double a = (lower[axis] - middle[axis]) / to_light[axis], b = (upper[axis] - middle[axis]) / to_light[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  const double room = 0.02 * (far - near);
  return {middle + (far + room) * to_light, middle + (near - room) * to_light};
}

Result<glm::dvec3> dark_place(const ShadowView& view) {
  std::vector<glm::vec3> points;
  const std::size_t step = std::max<std::size_t>(1, view.groom.vertex_count() / 2000);
  for (std::size_t v = 0; v < view.groom.vertex_count(); v += step) points.push_back(view.groom.positions[v]);
  // By truth where there is one: the darkest place of a map is where the map errs the most towards dark.
  const char* const judge = shadows::find_method("truth") ? "truth" : "deep_opacity";
  CUTICLE_ASSIGN(const std::vector<float> values, transmittance_at(view, judge, points));
  const auto darkest = std::min_element(values.begin(), values.end());
  return glm::dvec3(points[std::size_t(darkest - values.begin())]);
}

Result<std::vector<DepthCurve>> depth_curves(const ShadowView& view) {
  constexpr int steps = 160;
  const LightRay ray = light_ray(view);
  const double length = glm::distance(ray.from, ray.to);
  std::vector<glm::vec3> points;
  for (int k = 0; k <= steps; ++k) points.emplace_back(ray.from + (ray.to - ray.from) * (double(k) / steps));
  std::vector<std::string> names = {"truth"};
  names.insert(names.end(), view.methods.begin(), view.methods.end());
  std::vector<DepthCurve> curves;
  for (const std::string& name : names) {
    if (name == "truth" && !shadows::find_method(name)) continue;  // built without Embree
    CUTICLE_ASSIGN(const std::vector<float> values, transmittance_at(view, name, points));
    DepthCurve curve{name, {}};
    for (int k = 0; k <= steps; ++k) curve.points.push_back({length * k / steps, depth_of(values[std::size_t(k)])});
    curves.push_back(std::move(curve));
  }
  return curves;
}

namespace {

std::string file_of(const std::vector<Sheet>& sheets) {
  std::vector<glm::vec3> points;
  NamedArray depths{"optical_depth", "1", 1, {}};
  for (const Sheet& sheet : sheets) {
    points.insert(points.end(), sheet.positions.begin(), sheet.positions.end());
    depths.values.insert(depths.values.end(), sheet.depths.begin(), sheet.depths.end());
  }
  const std::vector<NamedArray> arrays = {std::move(depths)};
  return format_vts({sheets[0].columns, sheets[0].rows, int(sheets.size())}, points, arrays);
}

}  // namespace

Result<void> write_shadow(const ShadowView& shown, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  ShadowView view = shown;
  if (!view.through) {
    CUTICLE_ASSIGN(view.through, dark_place(view));
  }
  CUTICLE_ASSIGN(const auto opacity, opacity_sheets(view, 128));
  CUTICLE_ASSIGN(const auto deep, deep_opacity_sheets(view, 128));
  CUTICLE_TRY(write_text_file(folder + "/opacity_map.vts", file_of(opacity)));
  CUTICLE_TRY(write_text_file(folder + "/deep_opacity.vts", file_of(deep)));
  CUTICLE_ASSIGN(const TransmittanceVolume volume, transmittance_volume(view, 48));
  const std::vector<NamedArray> arrays = {{"transmittance", "1", 1, volume.values}};
  CUTICLE_TRY(write_text_file(folder + "/volume.vti", format_vti(volume.size, volume.origin, volume.spacing, arrays)));
  CUTICLE_ASSIGN(const auto curves, depth_curves(view));
  std::string text = "method,distance_m,optical_depth\n";
  for (const DepthCurve& curve : curves)
    for (const auto& point : curve.points) text += fmt::format("{},{},{}\n", curve.method, point[0], point[1]);
  return write_text_file(folder + "/ray.csv", text);
}

}  // namespace cuticle::viz
