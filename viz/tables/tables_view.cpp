#include "viz/tables/tables_view.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <vtkCamera.h>

namespace cuticle::viz {
namespace {

constexpr double k_height = 0.55;  // of the highest value over a table 1 wide
constexpr std::size_t k_max_rows = 3;

PlotAxis axis_of(const std::string& title, double lower, double upper) {
  const bool is_angle = title.ends_with("[deg]");
  return {title, lower, upper, is_angle ? PlotAxis::Kind::degrees : PlotAxis::Kind::number};
}

vtkSmartPointer<vtkActor> field_actor(const TableChannel& channel, const ColorScale& colors) {
  std::vector<glm::dvec3> points, shades;
  for (int y = 0; y < channel.height; ++y)
    for (int x = 0; x < channel.width; ++x) {
      const double value = double(channel.values[std::size_t(y) * std::size_t(channel.width) + std::size_t(x)]);
      points.emplace_back((x + 0.5) / channel.width, (y + 0.5) / channel.height,
                          k_height * value / std::max(channel.peak, 1e-30));
      shades.push_back(colors.color(value));
    }
  return smooth_actor(grid_data(points, channel.width, shades), 0.35);
}

void add_box(vtkRenderer& renderer, const TableChannel& channel, double scale) {
  const glm::dvec3 grey(0.55);
  renderer.AddActor(make_polyline({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}, grey, scale));
  renderer.AddActor(make_polyline({{0, 1, 0}, {0, 1, k_height}}, grey, scale));
  add_label(renderer, channel.u_title, {0.25, -0.32, 0}, 13 * scale);
  add_label(renderer, channel.v_title, {1.07, 0.35, 0}, 13 * scale);
  add_label(renderer, fmt::format("{:.3g}", channel.peak), {-0.12, 1, k_height}, 13 * scale);
  renderer.GetActiveCamera()->SetViewUp(0, 0, 1);
  renderer.GetActiveCamera()->SetFocalPoint(0.53, 0.45, 0.17);
  renderer.GetActiveCamera()->SetPosition(1.75, -2.1, 1.7);
  renderer.ResetCameraClippingRange();
}

}  // namespace

Result<void> TablesPicture::fill(const WindowArea& area) {
  CUTICLE_ASSIGN(channels_, table_channels(view_));
  scale_ = area.scale * 0.9;
  const std::size_t count = std::min(channels_.size(), k_max_rows);
  for (std::size_t k = 0; k < count; ++k) {
    const double top = 1 - double(k) / double(count), bottom = 1 - double(k + 1) / double(count);
    Row row;
    row.image = std::make_unique<Plot>(*area.add_renderer(0, bottom, 0.34, top), scale_);
    row.field = area.add_renderer(0.34, bottom, 0.64, top);
    row.error = std::make_unique<Plot>(*area.add_renderer(0.64, bottom, 1, top), scale_);
    rows_.push_back(std::move(row));
  }
  show_rows();
  return {};
}

void TablesPicture::show_rows() {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    rows_[k].channel = std::min(first_ + k, channels_.size() - 1);
    show(rows_[k]);
  }
}

void TablesPicture::show(Row& row) {
  const TableChannel& channel = channels_[row.channel];
  PlotContent image{fmt::format("{}, {} x {} texels", channel.name, channel.width, channel.height),
                    axis_of(channel.u_title, channel.u_lower, channel.u_upper),
                    axis_of(channel.v_title, channel.v_lower, channel.v_upper)};
  image.image = PlotImage{channel.width, channel.height, channel.values};
  image.colors =
      sequential_scale(channel.values, channel.name + (channel.unit == "1" ? "" : " [" + channel.unit + "]"));
  row.field->RemoveAllViewProps();
  if (channel.height > 1) {
    row.surface = field_actor(channel, image.colors);
    row.field->AddViewProp(row.surface);
    add_box(*row.field, channel, scale_);
  }
  row.image->set(std::move(image));
  show_error(row);
}

void TablesPicture::show_error(Row& row) {
  const TableChannel& channel = channels_[row.channel];
  PlotContent error{"error between texels", axis_of(channel.u_title, channel.u_lower, channel.u_upper),
                    axis_of(channel.v_title, channel.v_lower, channel.v_upper)};
  if (channel.errors.empty()) {
    error.title = "error: not of the model's own values";
    row.error->set(std::move(error));
    return;
  }
  std::vector<float> shares;
  for (const float value : channel.errors) shares.push_back(float(100 * double(value) / std::max(channel.peak, 1e-30)));
  error.colors = diverging_scale(shares, 0, "error / peak [%]");
  error.image = PlotImage{channel.error_width, channel.error_height, std::move(shares)};
  row.error->set(std::move(error));
}

Result<void> TablesPicture::change_table(std::size_t index) {
  view_.table = view_.set.tables[index].layout->name;
  CUTICLE_ASSIGN(channels_, table_channels(view_));
  first_ = 0;
  show_rows();
  return {};
}

std::vector<Control> TablesPicture::controls() {
  std::vector<Control> list;
  Control table{"table", "", 0, double(view_.set.tables.size()) - 1};
  for (std::size_t k = 0; k < view_.set.tables.size(); ++k) {
    table.choices.emplace_back(view_.set.tables[k].layout->name);
    if (table.choices.back() == view_.table) table.value = double(k);
  }
  table.set = [this](double value, bool) { return change_table(std::size_t(value)); };
  list.push_back(std::move(table));
  if (channels_.size() <= rows_.size()) return list;
  list.push_back({"first channel",
                  "",
                  0,
                  double(channels_.size() - rows_.size()),
                  double(first_),
                  {},
                  true,
                  [this](double value, bool) -> Result<void> {
                    first_ = std::size_t(value);
                    show_rows();
                    return {};
                  }});
  return list;
}

void TablesPicture::turn(double degrees) {
  for (const Row& row : rows_) {
    row.field->GetActiveCamera()->Azimuth(degrees);
    row.field->ResetCameraClippingRange();
  }
}

/// The value under the mouse, with the axes' values and the texel.
std::string TablesPicture::probe(const TableChannel& channel, const glm::dvec2& place) const {
  const double u = (place.x - channel.u_lower) / (channel.u_upper - channel.u_lower);
  const double v = (place.y - channel.v_lower) / (channel.v_upper - channel.v_lower);
  const int x = std::clamp(int(u * channel.width), 0, channel.width - 1);
  const int y = std::clamp(int(v * channel.height), 0, channel.height - 1);
  return fmt::format("channel,{}\n{},{:.6g}\n{},{:.6g}\ntexel,{} {}\nvalue,{:.9g}\n", channel.name, channel.u_title,
                     place.x, channel.v_title, place.y, x, y,
                     channel.values[std::size_t(y) * std::size_t(channel.width) + std::size_t(x)]);
}

Result<std::string> TablesPicture::pick(const glm::ivec2& pixel) {
  for (Row& row : rows_) {
    const auto place = row.image->place_of(glm::dvec2(pixel));
    if (!place) continue;
    PlotContent content = row.image->content();
    std::string words = probe(channels_[row.channel], *place);
    content.marks = {{*place, words.substr(words.rfind("value,") + 6, 8), {1, 1, 1}, true}};
    row.image->set(std::move(content));
    return words;
  }
  return std::string();
}

Result<void> TablesPicture::write_files(const std::string& folder) { return write_tables(view_.set, folder); }

}  // namespace cuticle::viz
