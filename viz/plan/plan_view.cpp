#include "viz/plan/plan_view.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace cuticle::viz {
namespace {

/// The picture in light grey, row 0 at the bottom.
std::vector<glm::dvec3> greys(const Image& picture) {
  std::vector<glm::dvec3> colors;
  for (int y = picture.height - 1; y >= 0; --y)
    for (int x = 0; x < picture.width; ++x) {
      const float mean = (picture.at(x, y, 0) + picture.at(x, y, 1) + picture.at(x, y, 2)) / 3;
      colors.emplace_back(0.55 + 0.4 * double(std::min(mean, 1.0F)));
    }
  return colors;
}

/// Each pixel with its tile's number.
CostMap over_pixels(const CostMap& tiles, const CostMap& pixels, int side) {
  CostMap map{pixels.width, pixels.height, {}};
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const int row = tiles.height - 1 - (map.height - 1 - y) / side;
      map.values.push_back(tiles.values[std::size_t(row) * std::size_t(tiles.width) + std::size_t(x / side)]);
    }
  return map;
}

}  // namespace

Result<void> PlanPicture::fill(const WindowArea& area) {
  for (int k = 0; k < 4; ++k) {
    const double x = 0.5 * (k % 2), y = k < 2 ? 0.5 : 0;
    plots_.push_back(std::make_unique<Plot>(*area.add_renderer(x, y, x + 0.5, y + 0.5), area.scale));
  }
  return update();
}

/// Numbers over the picture, which is seen where they are 0: x and y in pixels.
void PlanPicture::show(Plot& plot, const std::string& title, const std::string& bar, const CostMap& map) {
  PlotContent content{title, {"x [pixel]", 0, double(map.width)}, {"y [pixel]", 0, double(map.height)}};
  content.image = PlotImage{map.width, map.height, map.values};
  if (map.width == maps_.picture.width) content.image->beneath = greys(maps_.picture);
  content.colors = sequential_scale(map.values, bar);
  content.equal_scales = true;
  plot.set(std::move(content));
}

Result<void> PlanPicture::update() {
  CUTICLE_ASSIGN(maps_, read_plan(view_));
  const std::string name = std::filesystem::path(view_.file).filename().string();
  show(*plots_[0], fmt::format("{}: looked at, a pixel", name), "segments", maps_.cost);
  show(*plots_[1],
       fmt::format("shaded {:.1f} %, culled {:.1f} %, skipped {:.1f} %", 100 * maps_.shaded, 100 * maps_.culled,
                   100 * maps_.skipped),
       "shaded segments", maps_.samples);
  show(*plots_[2], fmt::format("mean of tiles of {0} x {0} pixels", view_.tile), "segments a pixel",
       over_pixels(maps_.tile_cost, maps_.cost, view_.tile));
  show(*plots_[3], "mean over the pixels of the strand seen there", "segments a pixel", maps_.strand_cost);
  return {};
}

std::vector<Control> PlanPicture::controls() {
  return {{"tile", "pixels", 2, 64, double(view_.tile), {}, true, [this](double value, bool) {
             view_.tile = int(value);
             return update();
           }}};
}

Result<std::string> PlanPicture::pick(const glm::ivec2& pixel) {
  for (const auto& plot : plots_) {
    const auto place = plot->place_of(glm::dvec2(pixel));
    if (!place) continue;
    const int x = std::min(int(place->x), maps_.cost.width - 1), y = std::min(int(place->y), maps_.cost.height - 1);
    const std::size_t at = std::size_t(y) * std::size_t(maps_.cost.width) + std::size_t(x);
    return fmt::format("x_px,{}\ny_px,{}\ncost,{:.9g}\nsamples,{:.9g}\n", x, y, maps_.cost.values[at],
                       maps_.samples.values[at]);
  }
  return std::string();
}

Result<void> PlanPicture::write_files(const std::string& folder) { return write_plan(view_, folder); }

}  // namespace cuticle::viz
