// Strands drawn as lines and as strips against the model itself: by its formulas on the device, and by tables.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "bsdf/model_gpu.h"
#include "core/random.h"
#include "lut/bake_gpu.h"
#include "render/pass_gpu.h"
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/lines/lines.h"
#include "tests/support/drawn_strands.h"
#include "tests/support/strand_angles.h"

namespace cuticle::render::drawn_direct_gpu_test {
namespace {

using tests::device, tests::upload;

constexpr int k_columns = 8, k_rows = 7, k_cell_px = 17, k_directions = 50, k_size = k_columns * k_cell_px;
constexpr double k_cell = 0.006, k_distance = 3;
const glm::dvec3 k_eye(0, 0, k_distance), k_to_light = glm::normalize(glm::dvec3(0.4, 0.5, 1)), k_irradiance(3, 2, 1);

/// Short straight strands with a vertex in the middles of the picture's cells, each in another direction.
struct Strands {
  std::vector<glm::dvec3> middles, directions;
  std::vector<glm::vec4> points, tangents;
  std::vector<std::uint32_t> segments;
  Strands() {
    RandomStream random(7);
    for (std::uint32_t k = 0; k < k_directions; ++k) {
      const double z = 1.9 * random.next_unit() - 0.95, turn = 2 * std::numbers::pi * random.next_unit();
      directions.emplace_back(std::sqrt(1 - z * z) * glm::dvec2(std::cos(turn), std::sin(turn)), z);
      middles.emplace_back(
          k_cell * glm::dvec2(k % k_columns - 0.5 * (k_columns - 1), 0.5 * (k_columns - 1) - k / k_columns), 0);
      segments.push_back(3 * k);
      segments.push_back(3 * k + 1);
      for (double end : {-1.0, 0.0, 1.0}) {
        points.emplace_back(middles.back() + 0.3 * k_cell * end * directions.back(), 0.15 * k_cell);
        tangents.emplace_back(directions.back(), 0.5 * (end + 1));
      }
    }
  }
};

Camera camera() {
  return {.position = k_eye,
          .target = {0, 0, 0},
          .vertical_field_of_view = 2 * std::atan(0.5 * k_columns * k_cell / k_distance),
          .resolution = {k_size, k_size}};
}

std::vector<glm::dvec3> expected(const Strands& strands, const bsdf::Model& model,
                                 const registry::ParameterValues& values) {
  std::vector<bsdf::Point> points;
  for (std::size_t k = 0; k < k_directions; ++k)
    points.push_back(tests::angles_at(strands.middles[k], strands.directions[k], k_eye, k_to_light));
  std::vector<glm::dvec3> scattered(points.size());
  EXPECT_TRUE(bsdf::evaluate(model, values, bsdf::Precision::f64, {.points = points}, scattered));
  for (glm::dvec3& value : scattered) value *= k_irradiance;
  return scattered;
}

/// What a frame reads of the material; `layout` null: its formulas.
struct Material {
  const bsdf::Model& model;
  const registry::ParameterValues& values;
  const lut::Layout* layout = nullptr;
};

void set_parameters(Resources& resources) {
  auto shared = registry::default_values(lines::entry().entry.parameters);
  for (std::string_view name : {"tip_variation", "variation", "ambient"}) shared.set(name, 0.0);
  shared.set("width_px", 3.0);
  resources.parameters["lines"] = shared;
}

/// The colour at the middle of each cell.
Result<std::vector<glm::dvec3>> draw(std::string_view way, const Resources& resources) {
  const auto entry = std::ranges::find(gpu_passes(), way, &GpuPassEntry::name);
  CUTICLE_ASSIGN(const auto pass, (*entry)->create(device(), resources));
  gpu::Commands commands = device()->record();
  CUTICLE_TRY(pass->record(commands, resources));
  CUTICLE_TRY(device()->submit(std::move(commands)));
  CUTICLE_ASSIGN(const std::vector<float> pixels, device()->download(*resources.get<Targets>().color));
  std::vector<glm::dvec3> colors;
  for (int k = 0; k < k_directions; ++k) {
    const int x = k % k_columns * k_cell_px + k_cell_px / 2, y = k / k_columns * k_cell_px + k_cell_px / 2;
    const float* pixel = pixels.data() + 4 * (y * k_size + x);
    colors.emplace_back(pixel[0], pixel[1], pixel[2]);
  }
  return colors;
}

Result<std::vector<glm::dvec3>> drawn(std::string_view way, const Strands& strands, const Material& material) {
  const gpu::Buffer vertices = upload(strands.points), segments = upload(strands.segments),
                    tangents = upload(strands.tangents);
  const gpu::Texture color = tests::target({k_size, k_size}, gpu::TextureFormat::rgba32f),
                     depth = tests::target({k_size, k_size}, gpu::TextureFormat::depth32f);
  lut::TableSet set;
  std::vector<gpu::Texture> textures;
  Resources resources;
  resources.edit<FrameView>().camera = camera();
  resources.edit<Lights>().all.push_back({"", k_to_light, k_irradiance});
  resources.edit<DrawnHair>().strands = {&vertices, &segments, 3 * k_directions, 2 * k_directions, {}};
  resources.edit<DrawnHair>().tangents = &tangents;
  resources.edit<DrawnHair>().vertices_per_strand = 3;
  resources.edit<FibreMaterial>().model = &material.model;
  resources.edit<FibreMaterial>().values = &material.values;
  resources.edit<FibreMaterial>().evaluates_directly = material.layout == nullptr;
  resources.edit<Targets>().color = resources.edit<Targets>().resolved = &color;
  resources.edit<Targets>().depth = &depth;
  resources.edit<Targets>().supersampling = 1;
  if (material.layout) {
    CUTICLE_ASSIGN(set, lut::bake(material.model, material.values, *material.layout, 128, silent_progress()));
    CUTICLE_ASSIGN(textures, lut::upload(*device(), set));
    for (const gpu::Texture& texture : textures) resources.edit<bake_tables::Tables>().textures.push_back(&texture);
    resources.edit<bake_tables::Tables>().set = &set;
  }
  set_parameters(resources);
  return draw(way, resources);
}

class EveryDrawnModel : public testing::TestWithParam<std::string> {};

TEST_P(EveryDrawnModel, StrandDrawnByItsFormulas_IsTheModelItself) {
  const bsdf::Model& model = **bsdf::find_model(GetParam());
  registry::ParameterValues values = registry::default_values(model.entry.parameters);
  if (model.near_field && model.near_field(values)) values.set("field", std::string("far"));
  const Strands strands;
  const std::vector<glm::dvec3> wanted = expected(strands, model, values);
  for (std::string_view way : {"lines", "quads"}) {
    const auto colors = drawn(way, strands, {model, values});
    ASSERT_TRUE(colors) << colors.error().message;
    const tests::Apart off = tests::apart(*colors, wanted);
    std::printf("%s, %s: at most %.5f of the value, %.5f of the peak\n", GetParam().c_str(), way.data(), off.relative,
                off.of_peak);
    EXPECT_LT(off.relative, 0.01);
  }
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const bsdf::GpuModel& model : bsdf::gpu_models()) list.emplace_back(model.name);
  return list;
}
INSTANTIATE_TEST_SUITE_P(DrawnDirect, EveryDrawnModel, testing::ValuesIn(names()),
                         [](const auto& info) { return info.param; });

// Of dark hair, whose tables no caustic spoils.
TEST(DrawnDirect, StrandDrawnByTables_IsNearTheModel) {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  const auto values = *registry::parse_assignments(model.entry.parameters, "beta=0.2,sigma_a=2/3/4");
  const Strands strands;
  for (std::string_view way : {"lines", "quads"}) {
    const auto colors = drawn(way, strands, {model, values, *lut::find_layout("nalu_theta")});
    ASSERT_TRUE(colors) << colors.error().message;
    const tests::Apart off = tests::apart(*colors, expected(strands, model, values));
    std::printf("%s by tables: %.5f rms, %.5f of the peak\n", way.data(), off.rms_of_rms, off.of_peak);
    EXPECT_LT(off.rms_of_rms, 0.01);
  }
}

}  // namespace
}  // namespace cuticle::render::drawn_direct_gpu_test
