#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <cuticle/shadows/deep_opacity/deep_opacity_gpu.h>
#include <cuticle/tests/support/groom_on_device.h>
#include <cuticle/tests/support/synthetic_grooms.h>

using namespace cuticle;
using namespace cuticle::shadows;

namespace {

using Words = std::vector<std::uint32_t>;

registry::ParameterValues values_of(const std::string& set) {
  return registry::parse_assignments((*find_method("deep_opacity"))->entry.parameters, set).value();
}

struct Frame {
  Words sums, nearest, ends;
  std::vector<float> transmittance;
  std::uint32_t planned = 0, recorded = 0;
};
Frame run(tests::GroomOnDevice& scene, const std::string& set, glm::dvec3 light, double alpha = 0.4) {
  auto shadow = deep_opacity::DeepOpacityGpu::create(scene.device, values_of(set)).value();
  gpu::Commands commands = scene.device->record();
  EXPECT_TRUE(shadow->record(commands, scene.strands, alpha, light, scene.transmittance));
  const auto cost = scene.device->submit(std::move(commands));
  EXPECT_TRUE(cost) << (cost ? "" : cost.error().message);
  Frame frame;
  frame.planned = shadow->dispatches_per_frame(scene.strands);
  for (const gpu::PassCost& pass : cost->passes) frame.recorded += pass.dispatches;
  const auto& map = static_cast<deep_opacity::DeepOpacityGpu&>(*shadow);
  const auto read = [&](const gpu::Buffer& buffer) {
    return gpu::read_buffer<std::uint32_t>(*scene.device, buffer, buffer.size() / 4).value();
  };
  frame.sums = read(map.sums());
  frame.nearest = read(map.nearest());
  frame.ends = read(map.ends());
  frame.transmittance = gpu::read_buffer<float>(*scene.device, scene.transmittance, scene.groom.vertex_count()).value();
  return frame;
}
void expect_same_integers(strands::Groom groom, const std::string& set, glm::dvec3 light, double alpha = 0.4) {
  tests::GroomOnDevice scene(std::move(groom));
  const Frame frame = run(scene, set, light, alpha);
  const auto settings = deep_opacity::settings_from(values_of(set)).value();
  const LightAxes axes = light_axes(unit_to_light(light).value());
  const deep_opacity::Map map = deep_opacity::build_map(scene.groom, alpha, axes, settings);
  for (std::uint32_t l = 0; l < settings.layers; ++l)
    EXPECT_EQ(frame.ends[l], map.ends.end[l]) << set << " layer " << l;
  EXPECT_EQ(frame.nearest, map.nearest) << set;
  EXPECT_EQ(frame.sums, map.sums) << set;
  EXPECT_GT(*std::max_element(map.sums.begin(), map.sums.end()), 0u);
}

}  // namespace

TEST(DeepOpacityGpu, SameGroom_SameIntegers) {
  expect_same_integers(tests::coat(3000, 8, 0.03, 1e-4f, 5), "layers=4,resolution=256", {1, 1, 0.3});
  expect_same_integers(tests::coat(3000, 8, 0.03, 2e-3f, 6), "layers=16,resolution=128,accumulate=poisson",
                       {-0.5, 0.3, 1});
  expect_same_integers(tests::coat(1000, 8, 0.03, 1e-4f, 5), "layers=8,resolution=64,spacing=geometric", {1, 1, 0.3});
  expect_same_integers(tests::coat(1000, 8, 0.03, 1e-4f, 5), "layers=3,resolution=64,spacing=equal", {1, 1, 0.3}, 1.0);
}

TEST(DeepOpacityGpu, StrandsAlongTheLight_SameIntegers) {
  strands::Groom groom;
  for (int i = 0; i < 50; ++i) {
    const float x = 0.001f * float(i);
    tests::add_strand(groom, {{x, 0.1f, 0}, {x, 0.05f, 1e-6f}, {x, 0, 0}}, 0.001f);
  }
  expect_same_integers(groom, "layers=8,resolution=64", {0, 1, 0});
}

TEST(DeepOpacityGpu, Lookup_AgreesWithTheCpu) {
  for (const std::string set : {"layers=4", "layers=8,accumulate=poisson,filter_texels=3", "layers=1,filter_texels=0",
                                "layers=4,filter_radius_mm=5,spacing=geometric"}) {
    tests::GroomOnDevice scene(tests::coat(2000, 8, 0.03, 1e-4f, 5));
    const Frame frame = run(scene, set, {1, 1, 0.3});
    const Method& method = **find_method("deep_opacity");
    const auto cpu = method.evaluate({&scene.groom, 0.4, {1, 1, 0.3}}, {scene.groom.positions, {}}, values_of(set));
    ASSERT_TRUE(cpu);
    float worst = 0;
    for (std::size_t v = 0; v < cpu->values.size(); ++v)
      worst = std::max(worst, std::abs(cpu->values[v] - frame.transmittance[v]));
    std::printf("%s: GPU against CPU %.2e\n", set.c_str(), double(worst));
    EXPECT_LT(worst, 2e-5f) << set;
  }
}

TEST(DeepOpacityGpu, TwoRuns_BitIdentical) {
  tests::GroomOnDevice scene(tests::coat(2000, 8, 0.03, 1e-4f, 5));
  const Frame first = run(scene, "layers=4", {1, 1, 0.3}), second = run(scene, "layers=4", {1, 1, 0.3});
  EXPECT_EQ(first.sums, second.sums);
  EXPECT_EQ(first.transmittance, second.transmittance);
}

TEST(DeepOpacityGpu, Dispatches_EqualThePlan) {
  tests::GroomOnDevice scene(tests::coat(100, 4, 0.03, 1e-4f, 5));
  const Frame frame = run(scene, "layers=4", {0, 1, 0});
  registry::FrameShape shape;
  shape.lights = 1;
  const registry::Entry& entry = (*find_method("deep_opacity"))->entry;
  EXPECT_EQ(frame.recorded, frame.planned);
  EXPECT_EQ(frame.recorded, entry.dispatches(registry::default_values(entry.parameters), shape));
}

TEST(DeepOpacityGpu, BadLightOrAlpha_IsRefused) {
  tests::GroomOnDevice scene(tests::coat(10, 4, 0.03, 1e-4f, 5));
  auto shadow = deep_opacity::DeepOpacityGpu::create(scene.device, values_of("layers=4,resolution=32")).value();
  gpu::Commands commands = scene.device->record();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(shadow->record(commands, scene.strands, 0.4, {0, 0, 0}, scene.transmittance));
  EXPECT_FALSE(shadow->record(commands, scene.strands, nan, {0, 1, 0}, scene.transmittance));
}
