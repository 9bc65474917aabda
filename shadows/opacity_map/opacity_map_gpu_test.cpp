#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <cuticle/shadows/opacity_map/opacity_map_gpu.h>
#include <cuticle/tests/support/groom_on_device.h>
#include <cuticle/tests/support/synthetic_grooms.h>

using namespace cuticle;
using namespace cuticle::shadows;

namespace {

registry::ParameterValues values_of(const std::string& set) {
  return registry::parse_assignments((*find_method("opacity_map"))->entry.parameters, set).value();
}

struct Frame {
  std::vector<std::uint32_t> sums;
  std::vector<float> transmittance;
  std::uint32_t planned = 0, recorded = 0;
};
Frame run(tests::GroomOnDevice& scene, const std::string& set, glm::dvec3 light, double alpha = 0.4) {
  auto shadow = opacity_map::OpacityMapGpu::create(scene.device, values_of(set)).value();
  gpu::Commands commands = scene.device->record();
  EXPECT_TRUE(shadow->record(commands, scene.strands, alpha, light, scene.transmittance));
  const auto cost = scene.device->submit(std::move(commands));
  EXPECT_TRUE(cost) << (cost ? "" : cost.error().message);
  Frame frame;
  frame.planned = shadow->dispatches_per_frame(scene.strands);
  for (const gpu::PassCost& pass : cost->passes) frame.recorded += pass.dispatches;
  const gpu::Buffer& sums = static_cast<opacity_map::OpacityMapGpu&>(*shadow).sums();
  frame.sums = gpu::read_buffer<std::uint32_t>(*scene.device, sums, sums.size() / 4).value();
  frame.transmittance = gpu::read_buffer<float>(*scene.device, scene.transmittance, scene.groom.vertex_count()).value();
  return frame;
}
std::vector<std::uint32_t> cpu_sums(const tests::GroomOnDevice& scene, const std::string& set, glm::dvec3 light, double alpha = 0.4) {
  const auto settings = opacity_map::settings_from(values_of(set)).value();
  const LightAxes axes = light_axes(unit_to_light(light).value());
  return opacity_map::build_map(scene.groom, alpha, axes, settings).sums;
}
void expect_same_integers(strands::Groom groom, const std::string& set, glm::dvec3 light, double alpha = 0.4) {
  tests::GroomOnDevice scene(std::move(groom));
  const Frame frame = run(scene, set, light, alpha);
  const std::vector<std::uint32_t> expected = cpu_sums(scene, set, light, alpha);
  std::size_t different = 0, filled = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    different += frame.sums[i] != expected[i];
    filled += expected[i] != 0;
  }
  EXPECT_EQ(different, 0u) << "of " << filled;
  EXPECT_GT(filled, 0u);
}

}  // namespace

TEST(OpacityMapGpu, SameGroom_SameIntegers) {
  expect_same_integers(tests::coat(3000, 8, 0.03, 1e-4f, 5), "slices=16,resolution=256", {1, 1, 0.3});
  expect_same_integers(tests::coat(3000, 8, 0.03, 2e-3f, 6), "slices=64,resolution=128,accumulate=poisson", {-0.5, 0.3, 1});
}

TEST(OpacityMapGpu, StrandsAlongTheLight_SameIntegers) {
  strands::Groom groom;
  for (int i = 0; i < 50; ++i)
    tests::add_strand(groom, {{0.001f * float(i), 0.1f, 0}, {0.001f * float(i), 0.05f, 1e-6f}, {0.001f * float(i), 0, 0}}, 0.001f);
  expect_same_integers(groom, "slices=32,resolution=64", {0, 1, 0});
}

TEST(OpacityMapGpu, OpaqueStrandsAndPrintedSpacing_SameIntegers) {
  expect_same_integers(tests::coat(500, 4, 0.05, 1e-3f, 8), "slices=5,resolution=64,spacing=printed", {0, 0.1, -1}, 1.0);
}

TEST(OpacityMapGpu, Lookup_AgreesWithTheCpu) {
  for (const std::string set : {"slices=16", "slices=32,accumulate=poisson,filter_texels=3", "slices=4,filter_texels=0", "slices=8,filter_radius_mm=0.1",
                                "slices=8,filter_radius_mm=5"}) {
    tests::GroomOnDevice scene(tests::coat(2000, 8, 0.03, 1e-4f, 5));
    const Frame frame = run(scene, set, {1, 1, 0.3});
    const Method& method = **find_method("opacity_map");
    const auto cpu = method.evaluate({&scene.groom, 0.4, {1, 1, 0.3}}, {scene.groom.positions, {}}, values_of(set));
    ASSERT_TRUE(cpu);
    float worst = 0;
    for (std::size_t v = 0; v < cpu->values.size(); ++v) worst = std::max(worst, std::abs(cpu->values[v] - frame.transmittance[v]));
    EXPECT_LT(worst, 2e-5f) << set;
  }
}

TEST(OpacityMapGpu, TwoRuns_BitIdentical) {
  tests::GroomOnDevice scene(tests::coat(2000, 8, 0.03, 1e-4f, 5));
  const Frame first = run(scene, "slices=16", {1, 1, 0.3}), second = run(scene, "slices=16", {1, 1, 0.3});
  EXPECT_EQ(first.sums, second.sums);
  EXPECT_EQ(first.transmittance, second.transmittance);
}

TEST(OpacityMapGpu, Dispatches_EqualThePlan) {
  tests::GroomOnDevice scene(tests::coat(100, 4, 0.03, 1e-4f, 5));
  const Frame frame = run(scene, "slices=16", {0, 1, 0});
  registry::FrameShape shape;
  shape.lights = 1;
  const registry::Entry& entry = (*find_method("opacity_map"))->entry;
  EXPECT_EQ(frame.recorded, frame.planned);
  EXPECT_EQ(frame.recorded, entry.dispatches(registry::default_values(entry.parameters), shape));
}

TEST(OpacityMapGpu, BadLightOrAlpha_IsRefused) {
  tests::GroomOnDevice scene(tests::coat(10, 4, 0.03, 1e-4f, 5));
  auto shadow = opacity_map::OpacityMapGpu::create(scene.device, values_of("slices=4,resolution=32")).value();
  gpu::Commands commands = scene.device->record();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(shadow->record(commands, scene.strands, 0.4, {0, 0, 0}, scene.transmittance));
  EXPECT_FALSE(shadow->record(commands, scene.strands, 0.4, {0, nan, 0}, scene.transmittance));
  EXPECT_FALSE(shadow->record(commands, scene.strands, nan, {0, 1, 0}, scene.transmittance));
}

TEST(OpacityMapGpu, MapBeyondTheDevice_IsRefused) {
  auto device = gpu::Device::open().value();
  const std::uint64_t limit = device->info().max_storage_buffer_bytes;
  const auto slices = std::max<std::uint64_t>(2, limit / (4ull * 4096 * 4096) + 2);
  if (slices > 33) GTEST_SKIP() << "this device holds the largest map";
  const auto shadow = opacity_map::OpacityMapGpu::create(device, values_of("resolution=4096,slices=" + std::to_string(slices)));
  ASSERT_FALSE(shadow);
  EXPECT_EQ(shadow.error().kind, ErrorKind::out_of_memory);
}
