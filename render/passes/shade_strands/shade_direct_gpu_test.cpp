// One strand in the picture against the model itself: by its formulas on the device and by tables.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "bsdf/model_gpu.h"
#include "core/random.h"
#include "lut/bake_gpu.h"
#include "render/pass_gpu.h"
#include "render/passes/lines/lines.h"
#include "render/passes/shade_strands/shade_strands.h"
#include "tests/support/drawn_strands.h"
#include "tests/support/strand_angles.h"

namespace cuticle::render::shade_direct_gpu_test {
namespace {

using tests::device, tests::upload;

constexpr std::uint32_t k_directions = 50;
const glm::dvec3 k_eye(0, 0, 3), k_to_light = glm::normalize(glm::dvec3(0.4, 0.5, 1)), k_irradiance(3, 2, 1);

/// Short straight strands at the middle of the view, each in another direction.
struct Strands {
  std::vector<glm::vec4> points, tangents;
  std::vector<std::uint32_t> segments;
  Strands() {
    RandomStream random(7);
    for (std::uint32_t k = 0; k < k_directions; ++k) {
      const double z = 1.9 * random.next_unit() - 0.95, turn = 2 * std::numbers::pi * random.next_unit();
      const glm::vec3 along(glm::dvec3(std::sqrt(1 - z * z) * glm::dvec2(std::cos(turn), std::sin(turn)), z));
      segments.push_back(2 * k);
      for (float end : {0.0f, 1.0f}) {
        points.emplace_back(0.01f * end * along, 1e-4f);
        tangents.emplace_back(along, end);
      }
    }
  }
};

/// Of every vertex: S of the model in double, times what arrives.
std::vector<glm::dvec3> expected(const Strands& strands, const bsdf::Model& model,
                                 const registry::ParameterValues& values) {
  std::vector<bsdf::Point> points;
  for (std::size_t v = 0; v < strands.points.size(); ++v)
    points.push_back(
        tests::angles_at(glm::dvec3(strands.points[v]), glm::dvec3(strands.tangents[v]), k_eye, k_to_light));
  std::vector<glm::dvec3> scattered(points.size());
  EXPECT_TRUE(bsdf::evaluate(model, values, bsdf::Precision::f64, {.points = points}, scattered));
  for (glm::dvec3& value : scattered) value *= k_irradiance;
  return scattered;
}

/// What shade_strands makes of them: `layout` null for the model's formulas.
Result<std::vector<glm::dvec3>> shaded(const Strands& strands, const bsdf::Model& model,
                                       const registry::ParameterValues& values, const lut::Layout* layout) {
  const gpu::Buffer vertices = upload(strands.points), segments = upload(strands.segments),
                    tangents = upload(strands.tangents);
  lut::TableSet set;
  std::vector<gpu::Texture> textures;
  FrameResources resources;
  resources.camera = {.position = k_eye, .target = {0, 0, 0}, .resolution = {64, 64}};
  resources.lights.push_back({"", k_to_light, k_irradiance});
  const auto count = std::uint32_t(strands.points.size());
  resources.strands = {&vertices, &segments, count, std::uint32_t(strands.segments.size()), {}};
  resources.tangents = &tangents;
  resources.vertices_per_strand = 2;
  resources.model = &model;
  resources.model_values = &values;
  resources.evaluates_directly = layout == nullptr;
  if (layout) {
    CUTICLE_ASSIGN(set, lut::bake(model, values, *layout, 128, silent_progress()));
    CUTICLE_ASSIGN(textures, lut::upload(*device(), set));
    for (const gpu::Texture& texture : textures) resources.tables.push_back(&texture);
    resources.table_set = &set;
  }
  auto shared = registry::default_values(lines::entry().entry.parameters);
  for (std::string_view name : {"tip_variation", "variation", "ambient"}) shared.set(name, 0.0);
  resources.parameters["lines"] = shared;
  const auto entry = std::ranges::find(gpu_passes(), "shade_strands", &GpuPassEntry::name);
  CUTICLE_ASSIGN(const auto pass, (*entry)->create(device(), resources));
  pass->publish(resources);
  gpu::Commands commands = device()->record();
  CUTICLE_TRY(pass->record(commands, resources));
  CUTICLE_TRY(device()->submit(std::move(commands)));
  CUTICLE_ASSIGN(const auto halves, gpu::read_buffer<std::uint64_t>(*device(), *resources.strand_colors, count));
  std::vector<glm::dvec3> colors;
  for (std::uint64_t half : halves) colors.emplace_back(glm::unpackHalf4x16(half));
  return colors;
}

class EveryGpuModel : public testing::TestWithParam<std::string> {};

TEST_P(EveryGpuModel, StrandInThePicture_IsTheModelItself) {
  const bsdf::Model& model = **bsdf::find_model(GetParam());
  registry::ParameterValues values = registry::default_values(model.entry.parameters);
  if (model.near_field && model.near_field(values)) values.set("field", std::string("far"));
  const Strands strands;
  const auto colors = shaded(strands, model, values, nullptr);
  ASSERT_TRUE(colors) << colors.error().message;
  const tests::Apart off = tests::apart(*colors, expected(strands, model, values));
  std::printf("%s: at most %.5f of the value, %.5f of the peak\n", GetParam().c_str(), off.relative, off.of_peak);
  EXPECT_LT(off.relative, 0.01);
  EXPECT_LT(off.of_peak, 0.002);
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const bsdf::GpuModel& model : bsdf::gpu_models()) list.emplace_back(model.name);
  return list;
}
INSTANTIATE_TEST_SUITE_P(ShadeDirect, EveryGpuModel, testing::ValuesIn(names()),
                         [](const auto& info) { return info.param; });

// Of dark hair, whose tables no caustic spoils.
TEST(ShadeDirect, TablesOverSinesAndOverAngles_AreNearTheModel) {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  const auto values = *registry::parse_assignments(model.entry.parameters, "beta=0.2,sigma_a=2/3/4");
  const Strands strands;
  const std::vector<glm::dvec3> wanted = expected(strands, model, values);
  for (const char* layout : {"nalu", "nalu_borders", "nalu_theta"}) {
    const auto colors = shaded(strands, model, values, *lut::find_layout(layout));
    ASSERT_TRUE(colors) << colors.error().message;
    const tests::Apart off = tests::apart(*colors, wanted);
    std::printf("%s: %.5f rms, %.5f of the peak\n", layout, off.rms_of_rms, off.of_peak);
    EXPECT_LT(off.rms_of_rms, 0.03);
  }
}

TEST(ShadeDirect, LayoutThatDrawingDoesNotRead_IsRefusedByName) {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  const auto refused =
      shaded(Strands(), model, registry::default_values(model.entry.parameters), *lut::find_layout("nalu2"));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("material.layout = 'nalu2'"), std::string::npos) << refused.error().message;
}

TEST(ShadeDirect, NearField_IsRefused) {
  const bsdf::Model& model = **bsdf::find_model("chiang");
  const auto values = *registry::parse_assignments(model.entry.parameters, "field=near");
  const auto refused = shaded(Strands(), model, values, nullptr);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("across the fibre"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace cuticle::render::shade_direct_gpu_test
