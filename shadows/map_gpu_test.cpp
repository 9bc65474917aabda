// Every method with passes on the device against its twin on the CPU, in every setting of its table of choices.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gpu/tests/test_device.h"
#include "shadows/clouds.h"
#include "shadows/groom_gpu.h"
#include "shadows/light_frame.h"
#include "shadows/opacity_map/map.h"
#include "tests/support/device_bound.h"
#include "tests/support/shadow_runs.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::shadows::map_gpu_test {

namespace {

using tests::device;

const Method& method_of(const GpuMethod& gpu) { return **find_method(gpu.name); }

/// The study's cases, the first two with other filters, and every other choice of a parameter that offers some; maps of
/// 96^2.
std::vector<std::string> settings_of(const Method& method) {
  const auto has = [&](std::string_view name) { return bool(registry::find_parameter(method.entry.parameters, name)); };
  std::vector<std::string> sets;
  for (const registry::StudyCase& study_case : method.entry.study_cases) sets.emplace_back(study_case.settings);
  for (const registry::Parameter& parameter : method.entry.parameters)
    for (const std::string_view choice : parameter.choices) {
      const std::string set = std::string(parameter.name) + "=" + std::string(choice);
      if (choice != parameter.default_text && std::find(sets.begin(), sets.end(), set) == sets.end())
        sets.push_back(set);
    }
  if (has("filter_radius_mm")) sets[0] += ",filter_radius_mm=2";
  if (has("filter_texels")) sets[1] += ",filter_texels=0";
  if (has("depth_offset_mm")) sets[0] += ",depth_offset_mm=0.5";
  for (std::string& set : sets) set += has("resolution") ? ",resolution=96" : "";
  for (std::string& set : sets) set += has("room_mib") ? ",room_mib=2" : "";
  return sets;
}

strands::Groom points() {
  const float radius = 5e-4f;
  return point_casters(tests::coat(300, 6, 0.03, 1e-4f, 9).positions, std::span(&radius, 1));
}

std::unique_ptr<GroomOnDevice> upload(const strands::Groom& hair, const std::optional<glm::vec3>& viewer,
                                      float fibre_width) {
  auto on_device = upload_groom(*device(), hair).value();
  on_device->strands.seen_from = viewer;
  on_device->strands.fibre_width = fibre_width;
  return on_device;
}
struct Scene {
  std::string name;
  strands::Groom hair;
  LightSource light;
  double alpha;
  std::optional<glm::vec3> viewer = {};
  float fibre_width = 1;
  std::unique_ptr<GroomOnDevice> on_device = upload(hair, viewer, fibre_width);
  tests::VertexReceivers receivers = tests::vertex_receivers(hair);
};
std::span<Scene> scenes() {
  static Scene all[] = {
      {"coat", tests::coat(1500, 8, 0.03, 1e-4f, 5), {{1, 1, 0.3}}, 0.4},
      {"opaque thick coat", tests::coat(200, 6, 0.03, 2e-3f, 6), {{-0.5, 0.3, 1}}, 1, glm::vec3(0.2f, 0.1f, 0.3f)},
      {"along the light", tests::along_the_light(), {{0, 1, 0}}, 0.4},
      {"points", points(), {{0, 0.1, -1}}, 0.4},
      {"point_light",
       tests::coat(1500, 8, 0.03, 1e-4f, 5),
       {{}, glm::dvec3(0.1, 0.11, 0.03)},
       0.4,
       glm::vec3(0.1f, 0.3f, -0.2f)},
      {"strands of many fibres",
       tests::coat(200, 6, 0.03, 2e-3f, 6),
       {{-0.5, 0.3, 1}},
       1,
       glm::vec3(0.2f, 0.1f, 0.3f),
       0.1f}};
  return all;
}

struct Frame {
  MapWords words;
  std::vector<float> transmittance;
  std::uint32_t planned = 0, recorded = 0;
};
Frame run(GpuShadow& shadow, Scene& scene) {
  gpu::Commands commands = device()->record();
  EXPECT_TRUE(
      shadow.record(commands, scene.on_device->strands, scene.alpha, scene.light, scene.on_device->transmittance));
  const auto cost = device()->submit(std::move(commands));
  EXPECT_TRUE(cost) << (cost ? "" : cost.error().message);
  Frame frame;
  frame.planned = shadow.dispatches_per_frame(scene.on_device->strands);
  for (const gpu::PassCost& pass : cost->passes) frame.recorded += pass.dispatches;
  for (const gpu::Buffer* buffer : shadow.map_buffers())
    frame.words.push_back(gpu::read_buffer<std::uint32_t>(*device(), *buffer, buffer->size() / 4).value());
  const std::size_t vertices = scene.hair.vertex_count();
  frame.transmittance = gpu::read_buffer<float>(*device(), scene.on_device->transmittance, vertices).value();
  return frame;
}

/// What one setting of a method gave on one scene, on both sides.
struct Comparison {
  std::string what;
  std::size_t words = 0, filled = 0, different = 0;
  double worst = 0;
};
Comparison compare(const GpuMethod& gpu, const registry::ParameterValues& values, GpuShadow& shadow, Scene& scene) {
  const Frame frame = run(shadow, scene);
  const Casters casters{&scene.hair, scene.alpha, scene.light.to_light, scene.light.position};
  Comparison comparison;
  const MapWords expected = gpu.cpu_map != nullptr ? gpu.cpu_map(casters, values).value() : MapWords{};
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (std::size_t word = 0; word < expected[i].size(); ++word) {
      ++comparison.words;
      comparison.filled += expected[i][word] != 0 && expected[i][word] != ~0u;
      comparison.different += frame.words[i][word] != expected[i][word];
    }
  Receivers receivers = scene.receivers.of(scene.hair);
  receivers.fibre_width = scene.fibre_width;
  if (scene.viewer) receivers.seen_from = *scene.viewer;
  const auto cpu = method_of(gpu).evaluate(casters, receivers, values).value();
  for (std::size_t v = 0; v < cpu.values.size(); ++v) {
    const double difference = std::abs(double(cpu.values[v]) - double(frame.transmittance[v]));
    comparison.worst = difference <= comparison.worst ? comparison.worst : difference;  // NaN is taken
  }
  return comparison;
}

/// Every setting of every method on every scene, run once.
const std::vector<Comparison>& comparisons() {
  static const std::vector<Comparison> all = [] {
    std::vector<Comparison> list;
    for (const GpuMethod* gpu : gpu_methods())
      for (const std::string& set : settings_of(method_of(*gpu))) {
        const auto values = tests::values_of(gpu->name, set).value();
        const auto shadow = gpu->create(device(), values);
        if (!shadow) {
          EXPECT_EQ(set, "storage=halves,resolution=96,room_mib=2") << gpu->name << ": " << shadow.error().message;
          continue;
        }
        for (Scene& scene : scenes()) {
          if (scene.light.position && gpu->name == "voxel") continue;
          list.push_back(compare(*gpu, values, **shadow, scene));
          list.back().what = std::string(gpu->name) + " " + set + ", " + scene.name;
        }
      }
    return list;
  }();
  return all;
}

/// A volume holds no segments without a length, and, by the width that they show, none along the light.
bool is_unseen(const std::string& what) {
  return what.starts_with("voxel") && (what.ends_with("points") || what.ends_with("along the light"));
}

}  // namespace

TEST(MapGpu, SameGroom_SameIntegers) {
  ASSERT_GT(comparisons().size(), 80u);
  for (const Comparison& comparison : comparisons()) {
    EXPECT_EQ(comparison.different, 0u) << comparison.what << ", of " << comparison.filled;
    EXPECT_TRUE(comparison.filled > 0 || comparison.words == 0 || is_unseen(comparison.what)) << comparison.what;
  }
}

/// More segments than the histogram of a deep opacity map counts, which takes one run of 64 in two.
TEST(MapGpu, ManySegments_SameIntegers) {
  Scene scene{"thick coat", tests::coat(20000, 8, 0.03, 2e-5f, 5), {{1, 1, 0.3}}, 0.4};
  const auto gpu = std::ranges::find(gpu_methods(), std::string_view("deep_opacity"), &GpuMethod::name);
  const auto values = tests::values_of("deep_opacity", "layers=8").value();
  const auto shadow = (*gpu)->create(device(), values).value();
  const Comparison comparison = compare(**gpu, values, *shadow, scene);
  EXPECT_EQ(comparison.different, 0u) << "of " << comparison.filled;
  EXPECT_LE(comparison.worst, 2e-5);
}

TEST(MapGpu, Lookup_AgreesWithTheCpu) {
  for (const Comparison& comparison : comparisons())
    if (comparison.words > 0) {
      const auto is_of = [&](std::string_view word) { return comparison.what.find(word) != std::string::npos; };
      // Moments lose digits where fibres lie at nearly one depth: what a GPU rounds otherwise shows there.
      const double bound = is_of("power_6")         ? tests::bound_for(*device(), 0.03, 0.045)
                           : is_of("deep_shadow")   ? 4.4e-4
                           : is_of("trigonometric") ? tests::bound_for(*device(), 6e-5, 3e-3)
                           : is_of("moments")       ? tests::bound_for(*device(), 2e-5, 1e-4)
                                                    : 2e-5;
      EXPECT_LT(comparison.worst, bound) << comparison.what;
    }
}

// N18: the drawn targets against integers that are rounded as their format does.
TEST(OpacityDrawn, EightBitsAndHalf_StayCloseToTheTwin) {
  for (const std::string form : {"graphics_8bit", "graphics_half"})
    for (std::size_t s = 0; s < 2; ++s) {
      Scene& scene = scenes()[s];
      const auto values = tests::values_of("opacity_map", "slices=17,resolution=96,form=" + form).value();
      const auto settings = settings_from<opacity_map::Settings>(values).value();
      const LightAxes axes = light_axes(scene.light, scene.on_device->strands.bounds).value();
      const opacity_map::Map twin = opacity_map::build_map(scene.hair, scene.alpha, axes, settings);
      const auto shadow = (*find_gpu_method("opacity_map"))->create(device(), values).value();
      run(*shadow, scene);
      double worst = 0, sum = 0;
      std::size_t filled = 0;
      for (std::size_t target = 0; target < 4; ++target) {
        const std::vector<float> texels = device()->download(*shadow->map_targets()[target]).value();
        for (std::size_t i = 0; i < texels.size(); ++i) {
          const double expected = twin.sums[16 * (i / 4) + 4 * target + i % 4] / twin.scale;
          const double difference = std::abs(double(texels[i]) - expected);
          worst = std::max(worst, difference);
          sum += difference;
          filled += expected > 0;
        }
      }
      std::printf("%s, %s: sigma differs by %.5f at most, %.6f in the mean of %zu\n", form.c_str(), scene.name.c_str(),
                  worst, sum / double(filled), filled);
      ASSERT_GT(filled, 1000u);
      EXPECT_LT(worst, 0.018);
      EXPECT_LT(sum / double(filled), 5e-4);
    }
}

TEST(OpacityDrawn, Transmittance_AgreesWithTheTwin) {
  for (const Comparison& comparison : comparisons())
    if (comparison.words == 0) {
      std::printf("%s: T differs by %.5f at most\n", comparison.what.c_str(), comparison.worst);
      EXPECT_LT(comparison.worst, 8e-3) << comparison.what;
    }
}

TEST(MapGpu, TwoRuns_BitIdentical) {
  for (const GpuMethod* gpu : gpu_methods()) {
    const auto shadow = gpu->create(device(), registry::default_values(method_of(*gpu).entry.parameters)).value();
    const Frame first = run(*shadow, scenes()[0]), second = run(*shadow, scenes()[0]);
    EXPECT_EQ(first.words, second.words) << gpu->name;
    EXPECT_EQ(first.transmittance, second.transmittance) << gpu->name;
    EXPECT_GT(shadow->bytes(), 0u) << gpu->name;
  }
}

TEST(MapGpu, Dispatches_EqualThePlan) {
  registry::FrameShape shape;
  shape.lights = 1;
  for (const GpuMethod* gpu : gpu_methods()) {
    const registry::Entry& entry = method_of(*gpu).entry;
    const auto values = registry::default_values(entry.parameters);
    const Frame frame = run(*gpu->create(device(), values).value(), scenes()[2]);
    EXPECT_EQ(frame.recorded, frame.planned) << gpu->name;
    EXPECT_EQ(frame.recorded, entry.dispatches(values, shape)) << gpu->name;
  }
}

TEST(MapGpu, BadLightOrAlpha_IsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  GroomOnDevice& groom = *scenes()[2].on_device;
  for (const GpuMethod* gpu : gpu_methods()) {
    const auto shadow = gpu->create(device(), registry::default_values(method_of(*gpu).entry.parameters)).value();
    gpu::Commands commands = device()->record();
    EXPECT_FALSE(shadow->record(commands, groom.strands, 0.4, {{0, 0, 0}}, groom.transmittance)) << gpu->name;
    EXPECT_FALSE(shadow->record(commands, groom.strands, 0.4, {{0, nan, 0}}, groom.transmittance)) << gpu->name;
    EXPECT_FALSE(shadow->record(commands, groom.strands, 0.4, {{}, glm::dvec3(nan)}, groom.transmittance)) << gpu->name;
    EXPECT_EQ(shadow->record(commands, groom.strands, 0.4, {{}, glm::dvec3(0, 2, 0)}, groom.transmittance).ok(),
              gpu->name != "voxel");
    EXPECT_FALSE(shadow->record(commands, groom.strands, nan, {{0, 1, 0}}, groom.transmittance)) << gpu->name;
  }
}

// The largest map of a method's table passes 2 GiB, which is refused, or the limits of the device, which says so.
TEST(MapGpu, MapBeyondTheDevice_IsRefused) {
  for (const GpuMethod* gpu : gpu_methods()) {
    auto values = registry::default_values(method_of(*gpu).entry.parameters);
    for (const registry::Parameter& parameter : method_of(*gpu).entry.parameters)
      if (parameter.type == registry::ParameterType::integer)
        values.set(parameter.name, std::int64_t(parameter.maximum));
    const auto shadow = gpu->create(device(), values);
    if (shadow && (*shadow)->bytes() <= device()->info().heap_bytes) continue;
    ASSERT_FALSE(shadow) << gpu->name;
    EXPECT_TRUE(shadow.error().kind == ErrorKind::out_of_memory || shadow.error().kind == ErrorKind::usage)
        << gpu->name;
  }
}

}  // namespace cuticle::shadows::map_gpu_test
