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
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/lines/lines.h"
#include "render/passes/shade_strands/shade_strands_gpu.h"
#include "render/strand_shading/tables_gpu.h"
#include "study/luts/table_sampler.h"
#include "tests/support/device_bound.h"
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
                                       const registry::ParameterValues& values, const lut::Layout* layout,
                                       int size = 128) {
  const gpu::Buffer vertices = upload(strands.points), segments = upload(strands.segments),
                    tangents = upload(strands.tangents);
  lut::TableSet set;
  std::vector<gpu::Texture> textures;
  Resources resources;
  resources.edit<FrameView>().camera = {.position = k_eye, .target = {0, 0, 0}, .resolution = {64, 64}};
  resources.edit<Lights>().all.push_back({"", k_to_light, k_irradiance});
  const auto count = std::uint32_t(strands.points.size());
  resources.edit<DrawnHair>().strands = {&vertices, &segments, count, std::uint32_t(strands.segments.size()), {}};
  resources.edit<DrawnHair>().tangents = &tangents;
  resources.edit<DrawnHair>().vertices_per_strand = 2;
  resources.edit<FibreMaterial>().model = &model;
  resources.edit<FibreMaterial>().values = &values;
  resources.edit<FibreMaterial>().evaluates_directly = layout == nullptr;
  if (layout) {
    CUTICLE_ASSIGN(set, lut::bake(model, values, *layout, size, silent_progress()));
    CUTICLE_ASSIGN(textures, strand_shading::upload_drawn(*device(), set, false));
    for (const gpu::Texture& texture : textures) resources.edit<bake_tables::Tables>().textures.push_back(&texture);
    resources.edit<bake_tables::Tables>().set = &set;
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
  CUTICLE_ASSIGN(const auto halves, gpu::read_buffer<std::uint64_t>(
                                        *device(), *resources.get<shade_strands::StrandColors>().values, count));
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

/// As a shader puts the stored tables together, on the CPU in float.
std::vector<glm::dvec3> read_from_tables(const Strands& strands, const lut::TableSet& set) {
  const study::TableSampler sampler = *study::TableSampler::make(set);
  std::vector<glm::dvec3> values;
  for (std::size_t v = 0; v < strands.points.size(); ++v) {
    const bsdf::Point at =
        tests::angles_at(glm::dvec3(strands.points[v]), glm::dvec3(strands.tangents[v]), k_eye, k_to_light);
    const glm::vec3 found =
        sampler.scattering({float(std::sin(at.theta_i)), float(std::sin(at.theta_o)), float(std::cos(at.phi))});
    values.push_back(glm::dvec3(found) * k_irradiance);
  }
  return values;
}

struct LayoutCase {
  const char *model, *settings, *layout;
  int size = 64;
};
class EveryLayout : public testing::TestWithParam<LayoutCase> {};

TEST_P(EveryLayout, StrandInThePicture_IsReadAsItsTermsSay) {
  const LayoutCase& each = GetParam();
  const bsdf::Model& model = **bsdf::find_model(each.model);
  const auto values = *registry::parse_assignments(model.entry.parameters, each.settings);
  const lut::Layout& layout = **lut::find_layout(each.layout);
  const Strands strands;
  const auto colors = shaded(strands, model, values, &layout, each.size);
  ASSERT_TRUE(colors) << colors.error().message;
  const lut::TableSet set = *lut::bake(model, values, layout, each.size, silent_progress());
  const tests::Apart off = tests::apart(*colors, read_from_tables(strands, set));
  std::printf("%s: at most %.5f of the value, %.5f of the peak\n", each.layout, off.relative, off.of_peak);
  // A GPU may weigh texels by 8 bits (Vulkan 1.3, subTexelPrecisionBits).
  EXPECT_LT(off.relative, tests::bound_for(*device(), 0.005, 0.013));
  EXPECT_LT(off.of_peak, 0.003);
}
INSTANTIATE_TEST_SUITE_P(
    ShadeDirect, EveryLayout,
    testing::Values(LayoutCase{"marschner", "", "nalu"}, LayoutCase{"marschner", "", "nalu_borders"},
                    LayoutCase{"marschner", "", "nalu_theta"}, LayoutCase{"marschner", "", "nalu_caustic"},
                    LayoutCase{"marschner", "", "nalu2"}, LayoutCase{"marschner", "variant=as_published", "barbu"},
                    LayoutCase{"marschner", "variant=as_published", "realengine"}, LayoutCase{"deon", "", "deon", 32},
                    LayoutCase{"chiang", "field=far", "chiang", 32}, LayoutCase{"kajiya_kay", "", "factored", 16}, LayoutCase{"karis", "", "karis"},
                    LayoutCase{"scheuermann", "", "half_vector"}, LayoutCase{"yan_fur", "field=far,azimuthal_tolerance=1e-2", "yan_fur", 16}),
    [](const auto& info) { return info.param.layout; });

struct DefaultCase {
  const char *model, *settings;
};

TEST(ShadeDirect, DefaultTables_AreTheModelWithinAPercent) {
  const Strands strands;
  for (const auto [name, settings] :
       {DefaultCase{"marschner", ""}, DefaultCase{"marschner", "sigma_a=0.06/0.1/0.2"},
        DefaultCase{"marschner", "beta=0.2,sigma_a=2/3/4"}, DefaultCase{"chiang", "field=far,sigma_a=0.06/0.1/0.2"},
        DefaultCase{"karis", ""}, DefaultCase{"scheuermann", ""}, DefaultCase{"kajiya_kay", ""},
        DefaultCase{"hairworks", ""}, DefaultCase{"deon", ""}, DefaultCase{"yan_fur", "field=far,azimuthal_tolerance=1e-4"}}) {
    const bsdf::Model& model = **bsdf::find_model(name);
    const auto values = *registry::parse_assignments(model.entry.parameters, settings);
    const auto colors = shaded(strands, model, values, *lut::find_layout(lut::k_best_layout, model, values));
    ASSERT_TRUE(colors) << colors.error().message;
    const tests::Apart off = tests::apart(*colors, expected(strands, model, values));
    std::printf("%s %s: %.5f rms, at most %.5f of the value, %.5f of the peak\n", name, settings, off.rms_of_rms,
                off.relative, off.of_peak);
    EXPECT_LT(off.rms_of_rms, 0.003);
    EXPECT_LT(off.of_peak, 0.003);
    EXPECT_LT(off.relative, 0.01);
  }
}

TEST(ShadeDirect, LayoutWhoseTablesDoNotMakeS_IsRefusedByName) {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  const auto refused = shaded(Strands(), model, registry::default_values(model.entry.parameters),
                              *lut::find_layout("dual_scattering"), 16);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("material.layout = 'dual_scattering'"), std::string::npos)
      << refused.error().message;
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
