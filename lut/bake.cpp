#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "core/wall_clock.h"
#include "lut/cell_average.h"

namespace cuticle::lut {
namespace {

constexpr int k_smallest = 16, k_largest = 1024;

/// Values of a channel's lobes at every texel, shared by the channels that differ in the colour component only.
struct LobeGrid {
  const Channel* channel = nullptr;
  std::vector<glm::dvec3> values;
  std::vector<std::uint8_t> singular;
};

std::vector<bsdf::Point> texel_points(const TableLayout& table, int size, double caustic_index) {
  std::vector<bsdf::Point> points;
  const glm::ivec2 texels = table_size(table, size);
  points.reserve(std::size_t(texels.x) * texels.y);
  for (int y = 0; y < texels.y; ++y)
    for (int x = 0; x < texels.x; ++x)
      points.push_back(make_point(table, axis_value(table.u, texels.x, (x + 0.5) / texels.x),
                                  axis_value(table.v, texels.y, (y + 0.5) / texels.y), texels.x, caustic_index));
  return points;
}

std::vector<PhiInterval> texel_cells(const TableLayout& table, int size) {
  std::vector<PhiInterval> cells;
  cells.reserve(std::size_t(size) * size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      cells.push_back(phi_interval(table, size, double(x) / size, (x + 1.0) / size, (y + 0.5) / size));
  return cells;
}

Result<LobeGrid> evaluate_grid(const Source& source, const Channel& channel, const TableLayout& table, int size) {
  LobeGrid grid{&channel, {}, {}};
  if (channel.texel == Texel::cell_average) {
    CUTICLE_ASSIGN(PhiAverages averages, average_over_phi(source, channel, texel_cells(table, size)));
    grid.values = std::move(averages.values);
    grid.singular = std::move(averages.singular);
  } else {
    CUTICLE_ASSIGN(grid.values, held_values(source, table, channel, texel_points(table, size, source.caustic_index)));
  }
  return grid;
}

void store(Table& table, int channel, const LobeGrid& grid) {
  const int component = table.layout->channels[channel].component;
  const std::size_t stride = table.layout->channels.size();
  for (std::size_t i = 0; i < grid.values.size(); ++i) {
    table.image.pixels[i * stride + channel] = float(grid.values[i][component]);
    if (!grid.singular.empty()) table.singular[i] |= grid.singular[i];
  }
}

}  // namespace

Result<void> check_size(int size) {
  if (size >= k_smallest && size <= k_largest) return {};
  return usage_error(fmt::format("size: {} is outside {} .. {}", size, k_smallest, k_largest), "--size 128");
}

Source cpu_source(const bsdf::Model& model, const registry::ParameterValues& values) {
  const Evaluate evaluate = [&model, values](const bsdf::Request& request, std::span<glm::dvec3> out) {
    return bsdf::evaluate(model, values, bsdf::Precision::f64, request, out);
  };
  const AzimuthalMeans means = [&model, values](int lobe, std::span<const bsdf::AzimuthInterval> intervals,
                                                std::span<bsdf::AzimuthMean> out) {
    return bsdf::azimuthal_means(model, values, lobe, intervals, out);
  };
  const double index = model.caustic_index ? model.caustic_index(values) : 0;
  return {&model,
          evaluate,
          evaluate,
          average_fibre(model, values),
          means,
          index,
          scattering_at_many(model, values),
          scattering_to_measure_by(model, values)};
}

Table empty_table(const TableLayout& layout, int size) {
  Table table;
  table.layout = &layout;
  std::vector<std::string> names;
  for (const Channel& channel : layout.channels) names.emplace_back(channel.name);
  table.scale.assign(names.size(), 1.0);
  const glm::ivec2 texels = table_size(layout, size);
  table.singular.assign(std::size_t(texels.x) * texels.y, 0);
  table.image = make_image(texels.x, texels.y, std::move(names));
  return table;
}

namespace {

void suit_channel(Image& image, int channel) {
  const Image points = image;
  const auto bend = [&](int x, int y, int step_x, int step_y) {
    return points.at(x - step_x, y - step_y, channel) + points.at(x + step_x, y + step_y, channel) -
           2 * points.at(x, y, channel);
  };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      float bent = 0;
      if (x > 0 && x + 1 < image.width) bent += bend(x, y, 1, 0);
      if (y > 0 && y + 1 < image.height) bent += bend(x, y, 0, 1);
      const float value = points.at(x, y, channel);
      image.at(x, y, channel) = std::max(value - bent / 12, value / 2);
    }
}

}  // namespace

void suit_to_filter(Table& table) {
  for (int c = 0; c < int(table.layout->channels.size()); ++c)
    if (table.layout->channels[std::size_t(c)].texel == Texel::for_filter) suit_channel(table.image, c);
}

Result<Table> bake_table(const Source& source, const TableLayout& layout, int size) {
  Table table = empty_table(layout, size);
  table.caustic_index = source.caustic_index;
  LobeGrid grid;
  for (int c = 0; c < int(layout.channels.size()); ++c) {
    const Channel& channel = layout.channels[c];
    if (channel.source == ChannelSource::solver) continue;
    if (!grid.channel || !same_lobes(*grid.channel, channel)) {
      CUTICLE_ASSIGN(grid, evaluate_grid(source, channel, layout, size));
    }
    store(table, c, grid);
  }
  suit_to_filter(table);
  return table;
}

bool same_lobes(const Channel& a, const Channel& b) {
  return a.source == b.source && a.quantity == b.quantity && a.lobe == b.lobe && a.texel == b.texel &&
         a.average == b.average;
}

Result<std::vector<int>> find_lobes(const bsdf::Model& model, std::string_view names) {
  std::vector<int> lobes;
  while (!names.empty()) {
    const std::string_view name = names.substr(0, names.find('+'));
    CUTICLE_ASSIGN(lobes.emplace_back(), bsdf::find_lobe(model, name));
    names.remove_prefix(std::min(name.size() + 1, names.size()));
  }
  return lobes;
}

Result<std::vector<glm::dvec3>> evaluate_points(const bsdf::Model& model, const Evaluate& evaluate,
                                                const Channel& channel, std::span<const bsdf::Point> points) {
  CUTICLE_ASSIGN(const std::vector<int> lobes, find_lobes(model, channel.lobe));
  std::vector<glm::dvec3> sum(points.size(), glm::dvec3(0)), values(points.size());
  for (int lobe : lobes) {
    CUTICLE_TRY(evaluate({channel.quantity, lobe, points}, values));
    for (std::size_t i = 0; i < values.size(); ++i) sum[i] += values[i];
  }
  return sum;
}

Result<std::vector<glm::dvec3>> channel_values(const Source& source, const Channel& channel,
                                               std::span<const bsdf::Point> points) {
  CUTICLE_EXPECT(channel.source != ChannelSource::solver, "a solved channel has no exact value");
  if (channel.source == ChannelSource::model) return evaluate_points(*source.model, source.evaluate, channel, points);
  std::vector<glm::dvec3> values;
  for (const bsdf::Point& point : points) {
    if (channel.source == ChannelSource::cos_theta_d) {
      values.emplace_back(std::cos(point.theta_d));
      continue;
    }
    CUTICLE_ASSIGN(const bsdf::DualScatteringRow row, source.average(point.theta_o));
    values.push_back(channel.average(row));
  }
  return values;
}

Result<std::vector<glm::dvec3>> held_values(const Source& source, const TableLayout& table, const Channel& channel,
                                            std::span<const bsdf::Point> points) {
  CUTICLE_ASSIGN(std::vector<glm::dvec3> values, channel_values(source, channel, points));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] /= left_out_factor(table, points[i], source.caustic_index);
  return values;
}

namespace {

/// Tables have no axis for the offset h.
Result<void> check_far_field(const bsdf::Model& model, const registry::ParameterValues& values, const Layout& layout) {
  if (layout.terms.empty() || !model.near_field || !model.near_field(values)) return {};
  return usage_error(fmt::format("{}: a near-field model depends on the offset h, for which '{}' has no axis",
                                 model.entry.name, layout.entry.name),
                     "choose a far-field model or setting (cuticle models)");
}

/// An axis from the caustic needs one whose place is known.
Result<void> check_caustic(const Source& source, const Layout& layout) {
  const bool measured = std::ranges::any_of(
      layout.tables, [](const TableLayout& table) { return table.u.quantity == AxisQuantity::from_caustic; });
  if (!measured || source.caustic_index > 1) return {};
  return usage_error(fmt::format("layout '{}' is measured from the caustic of a smooth circular fibre, which {} with "
                                 "these parameters has not",
                                 layout.entry.name, source.model->entry.name),
                     "--layout nalu_theta");
}

/// A layout may hold the terms of one model alone.
Result<void> check_model(const bsdf::Model& model, const Layout& layout) {
  if (layout.model.empty() || layout.model == model.entry.name) return {};
  return usage_error(fmt::format("layout '{}' holds the terms of the model {} alone, not those of {}",
                                 layout.entry.name, layout.model, model.entry.name),
                     "--layout auto");
}

/// The model must have every lobe that the layout's channels hold.
Result<void> check_lobes(const bsdf::Model& model, const Layout& layout) {
  for (const TableLayout& table : layout.tables)
    for (const Channel& channel : table.channels)
      if (const auto lobes = find_lobes(model, channel.lobe); channel.source == ChannelSource::model && !lobes)
        return usage_error(fmt::format("layout '{}' holds the lobes {} of a fibre; the model {} has {}",
                                       layout.entry.name, channel.lobe, model.entry.name, fmt::join(model.lobes, ", ")),
                           "choose another layout or model (cuticle models)");
  return {};
}

}  // namespace

Result<void> check_bakeable(const Source& source, const registry::ParameterValues& values, const Layout& layout) {
  CUTICLE_TRY(check_model(*source.model, layout));
  CUTICLE_TRY(check_far_field(*source.model, values, layout));
  CUTICLE_TRY(check_lobes(*source.model, layout));
  return check_caustic(source, layout);
}

std::size_t points_to_bake(const Layout& layout, int size) {
  std::size_t points = std::size_t(layout.points_of_mean) * std::size_t(size) * std::size_t(size) * std::size_t(size);
  for (const TableLayout& table : layout.tables) {
    const glm::ivec2 texels = table_size(table, size);
    for (const Channel& channel : table.channels)
      if (channel.source == ChannelSource::model && channel.component == 0)
        points += std::size_t(texels.x) * std::size_t(texels.y);
  }
  return points;
}

Result<double> seconds_to_bake(const Source& source, const Layout& layout, int size) {
  // As a solver asks: several viewers, each with many azimuths.
  constexpr std::size_t k_viewers = 8;
  const bool solves = layout.points_of_mean > 0;
  const std::size_t azimuths = solves ? std::size_t(layout.points_of_mean) * std::size_t(size) : 32;
  std::vector<bsdf::Point> points(k_viewers * azimuths);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {.theta_i = 0.5, .theta_o = 0.3 + 0.01 * double(i / azimuths), .phi = 0.01 * double(i % azimuths)};
  std::vector<glm::dvec3> values(points.size());
  const auto start = std::chrono::steady_clock::now();
  CUTICLE_TRY((solves ? source.many() : source.evaluate)({bsdf::Quantity::S, -1, points}, values));
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  return spent.count() / double(points.size()) * double(points_to_bake(layout, size));
}

Result<TableSet> bake_from(const Source& source, const registry::ParameterValues& values, const Layout& layout,
                           int size, Progress& progress) {
  CUTICLE_TRY(check_size(size));
  CUTICLE_TRY(check_bakeable(source, values, layout));
  TableSet set;
  set.layout = &layout;
  set.model = source.model;
  set.values = values;
  set.size = size;
  for (const TableLayout& table : layout.tables) {
    progress.update("bake", set.tables.size(), layout.tables.size());
    CUTICLE_ASSIGN(set.tables.emplace_back(), bake_table(source, table, size));
  }
  if (layout.solve) CUTICLE_TRY(layout.solve(source, set, progress));
  progress.update("bake", set.tables.size(), layout.tables.size());
  return set;
}

Result<TableSet> bake(const bsdf::Model& model, const registry::ParameterValues& values, const Layout& layout, int size,
                      Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const registry::ParameterValues held = table_values(model, values, layout);
  CUTICLE_ASSIGN(TableSet set, bake_from(cpu_source(model, held), held, layout, size, progress));
  set.bake_ms = milliseconds_since(start);
  set.baked_on = "cpu";
  return set;
}

double exact_value(const bsdf::Model& model, const registry::ParameterValues& values, const TableLayout& table,
                   const Channel& channel, double u, double v) {
  constexpr int k_exact_size = 1 << 20;  // the gap beside a caustic has no width
  const Source source = cpu_source(model, values);
  const bsdf::Point point =
      make_point(table, table.u.lower + u * (table.u.upper - table.u.lower),
                 table.v.lower + v * (table.v.upper - table.v.lower), k_exact_size, source.caustic_index);
  const auto result = held_values(source, table, channel, std::span(&point, 1));
  CUTICLE_EXPECT(result.ok(), "the model has the layout's lobes");
  return (*result)[0][channel.component];
}

}  // namespace cuticle::lut
