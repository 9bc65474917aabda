// Kernels, recorded work and what it costs.
#include <cstdlib>
#include <cstring>
#include <numeric>

#include "gpu/groups.h"
#include "gpu/tests/shared_device.h"

#include <scale_comp.spv.h>
#include <texels_comp.spv.h>

namespace cuticle::gpu::gpu_kernel_test {
namespace {

struct ScaleConstants {
  float factor;
  std::uint32_t count;
};

Kernel scale_kernel(std::uint32_t offset = 0) {
  return must(shared_device().make_kernel(
      scale_comp,
      {.storage_buffers = 2, .push_constant_bytes = sizeof(ScaleConstants), .specialization = {64, offset}}));
}

std::vector<float> ramp(std::size_t count) {
  std::vector<float> values(count);
  std::iota(values.begin(), values.end(), 1.0f);
  return values;
}

void scale(Commands& commands, const Kernel& kernel, const Buffer& from, const Buffer& to, float factor) {
  const ScaleConstants constants{factor, std::uint32_t(to.size() / sizeof(float))};
  const Groups groups = groups_for(constants.count);
  commands.dispatch(kernel, {&from, &to}, {}, bytes_of(constants), groups.x, groups.y);
}

TEST(GpuKernel, PushConstantsAndSpecialization_ReachTheShader) {
  Device& device = shared_device();
  const std::vector<float> data = ramp(1000);
  const Buffer source = must(make_buffer_from<float>(device, data)), target = must(device.make_buffer(4000));
  Commands commands = device.record();
  scale(commands, scale_kernel(7), source, target, 3);
  must(device.submit(std::move(commands)));
  const auto result = must(read_buffer<float>(device, target, data.size()));
  for (std::size_t i = 0; i < data.size(); ++i) EXPECT_EQ(result[i], data[i] * 3 + 7);
}

TEST(GpuKernel, MadeAgain_SharesItsPipeline) {
  Device& device = shared_device();
  const std::size_t none = device.pipelines_made();
  const ShaderInterface interface{
      .storage_buffers = 2, .push_constant_bytes = sizeof(ScaleConstants), .specialization = {64, 1234}};
  must(device.make_kernel(scale_comp, interface));
  const std::size_t one = device.pipelines_made();
  EXPECT_EQ(one, none + 1);
  must(device.make_kernel(std::vector<std::uint32_t>(scale_comp, std::end(scale_comp)), interface));
  EXPECT_EQ(device.pipelines_made(), one) << "the same code elsewhere, after the first kernel's end";
  std::vector<ShaderInterface> others(5, interface);
  others[0].specialization[1] = 1235;
  others[1].specialization.pop_back();
  others[2].storage_buffers = 3;
  others[3].push_constant_bytes = sizeof(ScaleConstants) + 4;
  others[4].textures = 1;
  for (const ShaderInterface& other : others) must(device.make_kernel(scale_comp, other));
  EXPECT_EQ(device.pipelines_made(), one + others.size());
}

TEST(GpuKernel, MoreThanAreKept_WorkAsBefore) {
  const std::shared_ptr<Device> device = open_device();
  const Buffer source = must(make_buffer_from<float>(*device, ramp(1))), target = must(device->make_buffer(4));
  const auto made = [&](std::uint32_t offset) {
    return must(device->make_kernel(scale_comp, {.storage_buffers = 2,
                                                 .push_constant_bytes = sizeof(ScaleConstants),
                                                 .specialization = {64, offset}}));
  };
  const Kernel first = made(0);
  for (std::uint32_t offset = 1; offset <= 600; ++offset) made(offset);
  EXPECT_EQ(device->pipelines_made(), 601u);
  made(600);
  EXPECT_EQ(device->pipelines_made(), 601u) << "the last are kept";
  made(1);
  EXPECT_EQ(device->pipelines_made(), 602u) << "the first go";
  Commands commands = device->record();
  scale(commands, first, source, target, 3);
  must(device->submit(std::move(commands)));
  EXPECT_EQ(must(read_buffer<float>(*device, target, 1))[0], 3) << "what is in use stays";
}

TEST(GpuKernel, EachDispatch_SeesWhatTheOneBeforeWrote) {
  Device& device = shared_device();
  const std::vector<float> data = ramp(20000);
  const Buffer a = must(make_buffer_from<float>(device, data)), b = must(device.make_buffer(a.size()));
  const Kernel kernel = scale_kernel(1);
  Commands commands = device.record();
  for (int i = 0; i < 5; ++i) {
    scale(commands, kernel, a, b, 2);
    scale(commands, kernel, b, a, 0.5f);
  }
  must(device.submit(std::move(commands)));
  const auto result = must(read_buffer<float>(device, a, data.size()));
  for (std::size_t i = 0; i < data.size(); ++i) ASSERT_EQ(result[i], data[i] + 7.5f);  // five times (2x + 1) / 2 + 1
}

TEST(GpuKernel, MoreThreadsThanOneAxisOfGroupsHolds_ReachEveryItem) {
  Device& device = shared_device();
  std::vector<float> data = ramp(32768 * 64 + 100);
  const Buffer source = must(make_buffer_from<float>(device, data)), target = must(device.make_buffer(source.size()));
  Commands commands = device.record();
  scale(commands, scale_kernel(), source, target, 2);
  must(device.submit(std::move(commands)));
  for (float& value : data) value *= 2;
  EXPECT_EQ(must(read_buffer<float>(device, target, data.size())), data);
}

TEST(GpuKernel, WrongNumberOfBuffers_IsRefusedAtSubmit) {
  Device& device = shared_device();
  const Buffer buffer = must(device.make_buffer(64));
  Commands commands = device.record();
  commands.dispatch(scale_kernel(), {&buffer}, {}, {}, 1);
  EXPECT_FALSE(device.submit(std::move(commands)).ok());
}

TEST(GpuKernel, BuffersReadAsTexels_AreConverted) {
  Device& device = shared_device();
  constexpr std::size_t k_items = 64;
  std::vector<std::uint32_t> words(4 * k_items);
  std::iota(words.begin(), words.end(), 0u);
  const std::vector<std::uint32_t> halves(2 * k_items, 0x4000'3c00u);  // 1, 2, 1, 2
  const Buffer a = must(make_buffer_from<std::uint32_t>(device, std::span(words).first(k_items))),
               b = must(make_buffer_from<std::uint32_t>(device, halves)),
               c = must(make_buffer_from<std::uint32_t>(device, words)), items = must(device.make_buffer(k_items * 16));
  const Kernel kernel = must(device.make_kernel(
      texels_comp, {.storage_buffers = 4, .texels = {{0}, {1, TextureFormat::rgba16f}, {2, TextureFormat::rgba32u}}}));
  Commands commands = device.record();
  commands.dispatch(kernel, {&a, &b, &c, &items}, {}, {}, 1);
  must(device.submit(std::move(commands)));
  const auto result = must(read_buffer<glm::vec4>(device, items, k_items));
  for (std::size_t i = 0; i < k_items; ++i) EXPECT_EQ(result[i], glm::vec4(float(i), 2, 2, float(4 * i + 3))) << i;
}

TEST(GpuKernel, PartsOfABuffer_AreWrittenEachByItsDispatch) {
  Device& device = shared_device();
  const Buffer source = must(make_buffer_from<float>(device, ramp(64))), target = must(device.make_texel_buffer(512));
  const Kernel kernel = scale_kernel();
  Commands commands = device.record();
  for (std::size_t k = 0; k < 2; ++k) scale(commands, kernel, source, part_of(target, 256 * k, 256), float(k + 2));
  must(device.submit(std::move(commands)));
  const auto result = must(read_buffer<float>(device, target, 128));
  for (std::size_t i = 0; i < 128; ++i) EXPECT_EQ(result[i], float(i % 64 + 1) * float(i / 64 + 2)) << i;
}

TEST(GpuKernel, TooManyPushConstants_AreRefusedNamingTheLimit) {
  const auto kernel = shared_device().make_kernel(scale_comp, {.storage_buffers = 2, .push_constant_bytes = 132});
  ASSERT_FALSE(kernel.ok());
  EXPECT_NE(kernel.error().message.find("0..128"), std::string::npos);
}

TEST(GpuKernel, BuffersDroppedAfterRecording_LiveUntilTheWorkIsDone) {
  Device& device = shared_device();
  const Buffer target = must(device.make_buffer(400));
  Commands commands = device.record();
  {
    const Buffer source = must(make_buffer_from<float>(device, ramp(100)));
    scale(commands, scale_kernel(), source, target, 2);
  }
  must(device.submit(std::move(commands)));
  EXPECT_EQ(must(read_buffer<float>(device, target, 100))[99], 200.0f);
}

TEST(GpuKernel, ManyDispatches_FitOneSubmission) {
  Device& device = shared_device();
  const Buffer a = must(make_buffer_from<float>(device, ramp(64))), b = must(device.make_buffer(a.size()));
  const Kernel kernel = scale_kernel();
  Commands commands = device.record();
  for (int i = 0; i < 200; ++i) {
    commands.begin_pass("pass " + std::to_string(i));
    scale(commands, kernel, a, b, 1);
    commands.end_pass();
  }
  const SubmitCost cost = must(device.submit(std::move(commands)));
  EXPECT_EQ(cost.passes.size(), 200u);
  EXPECT_EQ(cost.passes[199].name, "pass 199");
}

TEST(GpuKernel, StartedWork_EndsByItselfAndSaysWhatItCost) {
  Device& device = shared_device();
  const Buffer a = must(make_buffer_from<float>(device, ramp(100))), b = must(device.make_buffer(a.size()));
  Commands commands = device.record();
  commands.begin_pass("scale");
  scale(commands, scale_kernel(), a, b, 2);
  commands.end_pass();
  Running running = must(device.start(std::move(commands)));
  while (!running.is_done()) {
  }
  const SubmitCost cost = must(running.finish());
  EXPECT_EQ(cost.passes[0].dispatches, 1u);
  EXPECT_GT(cost.wall_ms, 0);
  EXPECT_EQ(must(read_buffer<float>(device, b, 100))[99], 200.0f);
}

TEST(GpuKernel, StartedWork_IsSeenByWhatIsSubmittedLater) {
  Device& device = shared_device();
  const Buffer a = must(make_buffer_from<float>(device, ramp(100000))), b = must(device.make_buffer(a.size())),
               c = must(device.make_buffer(a.size()));
  const Kernel kernel = scale_kernel();
  Commands first = device.record(), second = device.record();
  for (int k = 0; k < 20; ++k) scale(first, kernel, a, b, 2);
  scale(second, kernel, b, c, 3);
  const Running running = must(device.start(std::move(first)));
  must(device.submit(std::move(second)));
  EXPECT_EQ(must(read_buffer<float>(device, c, 100))[99], 600.0f);
}

TEST(GpuKernel, WrittenBytes_ReachTheKernelWithTheCommands) {
  Device& device = shared_device();
  const Buffer a = must(make_buffer_from<float>(device, ramp(64))), b = must(device.make_buffer(a.size()));
  Commands commands = device.record();
  {
    const std::vector<float> inserted = {50, 60};
    commands.write(a, std::as_bytes(std::span(inserted)), 4);
  }
  scale(commands, scale_kernel(), a, b, 1);
  must(device.submit(std::move(commands)));
  const auto result = must(read_buffer<float>(device, b, 64));
  EXPECT_EQ((std::vector(result.begin(), result.begin() + 4)), (std::vector<float>{1, 50, 60, 4}));
}

TEST(GpuKernel, WriteThatDoesNotFit_IsRefusedAtSubmit) {
  Device& device = shared_device();
  const Buffer small = must(device.make_buffer(8)), large = must(device.make_buffer(1 << 20));
  const std::vector<float> data(20000);
  Commands beyond = device.record(), too_much = device.record();
  beyond.write(small, std::as_bytes(std::span(data)).first(4000));
  too_much.write(large, std::as_bytes(std::span(data)));
  EXPECT_FALSE(device.submit(std::move(beyond)).ok());
  EXPECT_FALSE(device.submit(std::move(too_much)).ok());
}

TEST(GpuCost, Passes_CountTheirDispatchesAndTime) {
  Device& device = shared_device();
  const Buffer a = must(device.make_buffer(1 << 22)), b = must(device.make_buffer(1 << 22));
  const Kernel kernel = scale_kernel();
  Commands commands = device.record();
  commands.begin_pass("one");
  scale(commands, kernel, a, b, 2);
  commands.end_pass();
  commands.begin_pass("three");
  for (int i = 0; i < 3; ++i) scale(commands, kernel, a, b, 2);
  commands.end_pass();
  const SubmitCost cost = must(device.submit(std::move(commands)));
  ASSERT_EQ(cost.passes.size(), 2u);
  EXPECT_EQ(cost.passes[0].name, "one");
  EXPECT_EQ(cost.passes[0].dispatches, 1u);
  EXPECT_EQ(cost.passes[1].dispatches, 3u);
  EXPECT_EQ(cost.passes[1].draws, 0u);
  EXPECT_GT(cost.wall_ms, 0);
  if (device.info().timestamps) {
    EXPECT_GT(cost.passes[1].gpu_ms, 0);
    EXPECT_LE(cost.passes[0].gpu_ms + cost.passes[1].gpu_ms, cost.wall_ms);
  }
}

TEST(GpuCost, Trace_HoldsTheSubmissionAndItsPasses) {
  Device& device = shared_device();
  const Buffer a = must(device.make_buffer(1 << 16)), b = must(device.make_buffer(1 << 16));
  Trace trace;
  Commands commands = device.record();
  commands.begin_pass("scale");
  scale(commands, scale_kernel(), a, b, 2);
  commands.end_pass();
  must(device.submit(std::move(commands), &trace));
  int cpu = 0, gpu = 0;
  for (const Span& span : trace.spans()) {
    cpu += span.track == "cpu" && span.name == "submit";
    gpu += span.track == "gpu" && span.name == "scale";
  }
  EXPECT_EQ(cpu, 1);
  EXPECT_EQ(gpu, device.info().timestamps ? 1 : 0);
}

TEST(GpuCost, PassInsideAnother_IsPartOfIt) {
  Commands commands = shared_device().record();
  commands.begin_pass("outer");
  for (int k = 0; k < 2; ++k) {
    commands.begin_pass("inner");
    commands.end_pass();
  }
  commands.end_pass();
  const auto cost = shared_device().submit(std::move(commands));
  ASSERT_TRUE(cost.ok()) << cost.error().message;
  ASSERT_EQ(cost->passes.size(), 1u);
  EXPECT_EQ(cost->passes[0].name, "outer");
}

TEST(GpuCost, PassLeftOpen_IsRefusedByName) {
  Commands commands = shared_device().record();
  commands.begin_pass("forgotten");
  const auto cost = shared_device().submit(std::move(commands));
  ASSERT_FALSE(cost.ok());
  EXPECT_NE(cost.error().message.find("forgotten"), std::string::npos);
}

// The shader reads push constants that its interface does not declare: the validation layer must notice, and say so
// once.
TEST(GpuValidation, MisdeclaredShader_FailsTheNextSubmitOnly) {
  const auto device = open_device();
  auto kernel =
      device->make_kernel(scale_comp, {.storage_buffers = 2, .push_constant_bytes = 0, .specialization = {64, 0}});
  const auto cost = device->submit(device->record());
  ASSERT_FALSE(cost.ok());
  EXPECT_EQ(cost.error().kind, ErrorKind::internal);
  EXPECT_NE(cost.error().message.find("validation"), std::string::npos);
  EXPECT_TRUE(device->submit(device->record()).ok());
}

// Runs under scripts/gpu_assisted_validation.sh, which switches the layer's instrumented shaders on.
TEST(GpuValidation, WritePastABuffer_IsNamedByInstrumentedShaders) {
  const char* enabled = std::getenv("VK_LAYER_ENABLES");
  if (!enabled || !std::strstr(enabled, "GPU_ASSISTED")) GTEST_SKIP() << "GPU-assisted validation is off";
  const auto device = open_device();
  const Kernel kernel = must(device->make_kernel(
      scale_comp, {.storage_buffers = 2, .push_constant_bytes = sizeof(ScaleConstants), .specialization = {64, 0}}));
  const Buffer source = must(device->make_buffer(4096)), target = must(device->make_buffer(64));
  Commands commands = device->record();
  commands.dispatch(kernel, {&source, &target}, {}, bytes_of(ScaleConstants{1, 1000}), groups_for(1000).x, 1);
  const auto cost = device->submit(std::move(commands));
  ASSERT_FALSE(cost.ok());
  EXPECT_NE(cost.error().message.find("out of bounds"), std::string::npos) << cost.error().message;
}

}  // namespace
}  // namespace cuticle::gpu::gpu_kernel_test
