#include "viz/plan/plan.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/file.h"
#include "viz/files/vtk_xml.h"

namespace cuticle::viz {
namespace {

int find_channel(const Image& image, std::string_view name) {
  const auto found = std::find(image.channel_names.begin(), image.channel_names.end(), name);
  return found == image.channel_names.end() ? -1 : int(found - image.channel_names.begin());
}

Result<CostMap> layer(const Image& image, const std::string& file, std::string_view name) {
  const int channel = find_channel(image, name);
  if (channel < 0)
    return bad_input(fmt::format("{}: the picture has no layer '{}'", file, name),
                     "cuticle render SCENE --aovs --out DIR");
  CostMap map{image.width, image.height, {}};
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x) map.values.push_back(image.at(x, y, channel));
  return map;
}

CostMap tile_means(const CostMap& pixels, int side) {
  CostMap tiles{(pixels.width + side - 1) / side, (pixels.height + side - 1) / side, {}};
  std::vector<int> counts(std::size_t(tiles.width) * std::size_t(tiles.height), 0);
  tiles.values.assign(counts.size(), 0);
  for (int y = 0; y < pixels.height; ++y)
    for (int x = 0; x < pixels.width; ++x) {
      // Tiles count from the top left corner of the picture.
      const int row = tiles.height - 1 - (pixels.height - 1 - y) / side;
      const std::size_t tile = std::size_t(row) * std::size_t(tiles.width) + std::size_t(x / side);
      tiles.values[tile] += pixels.values[std::size_t(y) * std::size_t(pixels.width) + std::size_t(x)];
      ++counts[tile];
    }
  for (std::size_t i = 0; i < counts.size(); ++i) tiles.values[i] /= float(std::max(1, counts[i]));
  return tiles;
}

CostMap strand_means(const CostMap& cost, const CostMap& strands) {
  std::map<int, std::pair<double, int>> sums;
  for (std::size_t i = 0; i < cost.values.size(); ++i) {
    auto& [sum, count] = sums[int(strands.values[i])];
    sum += double(cost.values[i]);
    ++count;
  }
  CostMap means{cost.width, cost.height, {}};
  for (const float strand : strands.values) {
    const auto& [sum, count] = sums[int(strand)];
    means.values.push_back(strand > 0 ? float(sum / count) : 0.0F);
  }
  return means;
}

void count_pixels(PlanMaps& maps, const CostMap& coverage) {
  const double all = double(coverage.values.size());
  for (std::size_t i = 0; i < coverage.values.size(); ++i) {
    if (coverage.values[i] > 0)
      maps.shaded += 1 / all;
    else if (maps.cost.values[i] > 0)
      maps.culled += 1 / all;
    else
      maps.skipped += 1 / all;
  }
}

}  // namespace

Result<PlanMaps> read_plan(const PlanView& view) {
  CUTICLE_ASSIGN(const Image image, read_exr(view.file));
  PlanMaps maps;
  CUTICLE_ASSIGN(maps.cost, layer(image, view.file, "cost.Y"));
  CUTICLE_ASSIGN(maps.samples, layer(image, view.file, "samples.Y"));
  CUTICLE_ASSIGN(const CostMap strands, layer(image, view.file, "strand.id"));
  CUTICLE_ASSIGN(const CostMap coverage, layer(image, view.file, "coverage.Y"));
  maps.tile_cost = tile_means(maps.cost, view.tile);
  maps.strand_cost = strand_means(maps.cost, strands);
  count_pixels(maps, coverage);
  if (find_channel(image, "R") < 0 || find_channel(image, "G") < 0 || find_channel(image, "B") < 0) return maps;
  Image colors = make_image(image.width, image.height, {"R", "G", "B"});
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        colors.at(x, y, c) = image.at(x, y, find_channel(image, colors.channel_names[std::size_t(c)]));
  maps.picture = tone_map(colors);
  return maps;
}

Result<void> write_plan(const PlanView& view, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  CUTICLE_ASSIGN(const PlanMaps maps, read_plan(view));
  const std::vector<NamedArray> pixels = {{"cost", "segments", 1, maps.cost.values},
                                          {"samples", "segments", 1, maps.samples.values},
                                          {"strand_cost", "segments", 1, maps.strand_cost.values}};
  const std::vector<NamedArray> tiles = {{"tile_cost", "segments per pixel", 1, maps.tile_cost.values}};
  CUTICLE_TRY(write_text_file(folder + "/costs.vti",
                              format_vti({maps.cost.width, maps.cost.height, 1}, {0, 0, 0}, {1, 1, 1}, pixels)));
  const double side = view.tile;
  return write_text_file(folder + "/tiles.vti", format_vti({maps.tile_cost.width, maps.tile_cost.height, 1},
                                                           {side / 2, side / 2, 0}, {side, side, 1}, tiles));
}

}  // namespace cuticle::viz
