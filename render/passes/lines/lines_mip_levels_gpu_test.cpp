// Curls narrower than a few pixels: the lookups of neighbouring pixels lie far apart in the tables. A curtain of
// strands that wave towards the eye, at one sample a pixel with and without mip levels, beside the mean of 8 x 8
// samples.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "gpu/tests/test_device.h"
#include "lut/bake_gpu.h"
#include "render/pass_gpu.h"
#include "render/passes/bake_tables/bake_tables.h"
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/lines/lines.h"

namespace cuticle::render::lines_mip_levels_gpu_test {
namespace {

constexpr int k_pixels = 48, k_fine = 8;
constexpr int k_vertices = 4 * k_pixels;  ///< of a strand
constexpr int k_strands = 2 * k_pixels;

using tests::device;

const lut::TableSet& tables() {
  static const lut::TableSet set = [] {
    const bsdf::Model& model = **bsdf::find_model("marschner");
    return *lut::bake(model, *registry::parse_assignments(model.entry.parameters, "sigma_a=0.2/0.4/0.8,beta=0.1"),
                      **lut::find_layout("nalu"), 128, silent_progress());
  }();
  return set;
}

gpu::Texture target(int size, gpu::TextureFormat format) {
  return std::move(*device()->make_texture({{size, size}, format, gpu::Filter::nearest, 1, true}));
}

/// Upright strands across a square of 1 m; each waves along the view with this period, up to a slope of 1.
class Curtain {
 public:
  explicit Curtain(double period_px) {
    const double wave = 2 * std::numbers::pi * k_pixels / period_px;
    std::vector<glm::vec4> vertices, tangents;
    for (int s = 0; s < k_strands; ++s)
      for (int i = 0; i < k_vertices; ++i) {
        const double x = (s + 0.5) / k_strands - 0.5, y = double(i) / (k_vertices - 1) * 1.1 - 0.55;
        const double phase = wave * y;
        vertices.emplace_back(x, y, std::sin(phase) / wave, 1e-4f);
        tangents.emplace_back(glm::normalize(glm::dvec3(0.2, 1, std::cos(phase))), double(i) / (k_vertices - 1));
      }
    vertices_ = *gpu::make_buffer_from<glm::vec4>(*device(), vertices);
    tangents_ = *gpu::make_buffer_from<glm::vec4>(*device(), tangents);
  }

  /// RGB of each pixel; `fine`: samples across it, of which the mean is taken.
  std::vector<glm::dvec3> picture(bool mip_levels, int fine) const {
    const int size = k_pixels * fine;
    const gpu::Texture color = target(size, gpu::TextureFormat::rgba32f),
                       depth = target(size, gpu::TextureFormat::depth32f);
    const std::vector<gpu::Texture> textures = *lut::upload(*device(), tables(), mip_levels);
    Resources resources = resources_of(mip_levels, size, fine);
    resources.edit<Targets>().color = resources.edit<Targets>().resolved = &color;
    resources.edit<Targets>().depth = &depth;
    resources.edit<bake_tables::Tables>().set = &tables();
    for (const gpu::Texture& texture : textures) resources.edit<bake_tables::Tables>().textures.push_back(&texture);
    const auto entry = std::ranges::find(gpu_passes(), "lines", &GpuPassEntry::name);
    const auto pass = std::move(*(*entry)->create(device(), resources));
    gpu::Commands commands = device()->record();
    EXPECT_TRUE(pass->record(commands, resources));
    EXPECT_TRUE(device()->submit(std::move(commands)));
    return means(*device()->download(color), fine);
  }

 private:
  Resources resources_of(bool mip_levels, int size, int fine) const {
    Resources resources;
    resources.edit<FrameView>().camera = {
        .position = {0, 0, 10}, .vertical_field_of_view = 0.09, .resolution = {size, size}};
    resources.edit<Lights>().all = {
        {.name = "", .to_light = glm::normalize(glm::dvec3(0.3, 0.5, 1)), .irradiance = {1, 1, 1}}};
    resources.edit<DrawnHair>().strands = {
        &vertices_, nullptr, k_strands * k_vertices, 0, {{-0.5f, -0.5f, -0.1f}, {0.5f, 0.5f, 0.1f}}};
    resources.edit<DrawnHair>().tangents = &tangents_;
    resources.edit<DrawnHair>().vertices_per_strand = k_vertices;
    resources.edit<Targets>().supersampling = 1;
    registry::ParameterValues values = registry::default_values(lines::entry().entry.parameters);
    values.set("width_px", 1.5 * fine);
    values.set("variation", 0.0);
    values.set("tip_variation", 0.0);
    values.set("ambient", 0.0);
    resources.parameters["lines"] = values;
    resources.parameters["bake_tables"] = registry::default_values(bake_tables::entry().entry.parameters);
    resources.parameters["bake_tables"].set("mip_levels", mip_levels);
    return resources;
  }

  static std::vector<glm::dvec3> means(const std::vector<float>& pixels, int fine) {
    std::vector<glm::dvec3> sums(std::size_t(k_pixels) * k_pixels, glm::dvec3(0));
    const int size = k_pixels * fine;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        for (int c = 0; c < 3; ++c)
          sums[std::size_t(y / fine) * k_pixels + x / fine][c] +=
              double(pixels[4 * (std::size_t(y) * size + x) + c]) / (fine * fine);
    return sums;
  }

  gpu::Buffer vertices_, tangents_;
};

/// Over the mean of the truth.
double error(const std::vector<glm::dvec3>& picture, const std::vector<glm::dvec3>& truth) {
  double apart = 0, all = 0;
  for (std::size_t p = 0; p < truth.size(); ++p)
    for (int c = 0; c < 3; ++c) apart += std::abs(picture[p][c] - truth[p][c]), all += truth[p][c];
  return apart / all;
}

TEST(LinesMipLevels, NarrowCurls_AreNearerTheTruthThanWithout) {
  for (const double period_px : {4.0, 8.0, 16.0, 32.0, 64.0}) {
    const Curtain curtain(period_px);
    const auto truth = curtain.picture(false, k_fine);
    const double without = error(curtain.picture(false, 1), truth), with = error(curtain.picture(true, 1), truth);
    std::printf("curls of %2.0f pixels: error %.3f of the mean without mip levels, %.3f with them\n", period_px,
                without, with);
    EXPECT_LT(with, 0.75 * without) << period_px;
  }
}

}  // namespace
}  // namespace cuticle::render::lines_mip_levels_gpu_test
