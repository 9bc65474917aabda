#include "tests/hard_cases/elementary_gpu.h"

#include <bit>

#include <elementary_comp.spv.h>

namespace cuticle::hard_cases {
namespace {

constexpr std::uint32_t k_random_words = 8;

struct Constants {
  std::uint32_t function, count;
};

Result<std::vector<std::uint32_t>> run(gpu::Device& device, std::uint32_t function, std::span<const glm::vec2> arguments) {
  const Constants constants{function, std::uint32_t(arguments.size())};
  CUTICLE_ASSIGN(const gpu::Kernel kernel,
                 device.make_kernel(elementary_comp, {.storage_buffers = 2, .push_constant_bytes = sizeof(Constants)}));
  CUTICLE_ASSIGN(const gpu::Buffer from, gpu::make_buffer_from<glm::vec2>(device, arguments));
  CUTICLE_ASSIGN(const gpu::Buffer to, device.make_buffer(arguments.size() * sizeof(std::uint32_t)));
  gpu::Commands commands = device.record();
  commands.dispatch(kernel, {&from, &to}, {}, gpu::bytes_of(constants), (constants.count + 63) / 64);
  CUTICLE_TRY(device.submit(std::move(commands)));
  return gpu::read_buffer<std::uint32_t>(device, to, arguments.size());
}

}  // namespace

Result<std::vector<float>> elementary_gpu(gpu::Device& device, std::uint32_t index, std::span<const glm::vec2> arguments) {
  CUTICLE_ASSIGN(const std::vector<std::uint32_t> words, run(device, index, arguments));
  std::vector<float> values;
  for (std::uint32_t word : words) values.push_back(std::bit_cast<float>(word));
  return values;
}

Result<std::vector<std::uint32_t>> random_words_gpu(gpu::Device& device, std::uint32_t count) {
  return run(device, k_random_words, std::vector<glm::vec2>(count));
}

}  // namespace cuticle::hard_cases
