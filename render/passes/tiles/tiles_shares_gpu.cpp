#include "render/passes/tiles/tiles_shares_gpu.h"

#include <algorithm>
#include <bit>

#include <tiles_shares_comp.spv.h>
#include <tiles_shares_records_comp.spv.h>
#include <tiles_shares_spans_comp.spv.h>
#include <tiles_shares_spans_records_comp.spv.h>

namespace cuticle::render::tiles {

namespace {

constexpr std::size_t k_head_words = 4, k_record_words = 8;  ///< of seen_shares.glsl
constexpr std::size_t k_max_bytes = std::size_t(256) << 20;

std::span<const std::uint32_t> code_of(const FineForm& form) {
  using Code = std::span<const std::uint32_t>;
  if (form.spans) return form.reads_records ? Code(tiles_shares_spans_records_comp) : Code(tiles_shares_spans_comp);
  return form.reads_records ? Code(tiles_shares_records_comp) : Code(tiles_shares_comp);
}

void append(std::vector<SeenShare>& shares, std::span<const std::uint32_t> words, std::uint32_t vertices_per_strand) {
  const auto real = [&](std::size_t k) { return std::bit_cast<float>(words[k]); };
  for (std::size_t at = k_head_words; at + k_record_words <= words.size(); at += k_record_words)
    shares.push_back({words[at],
                      words[at + 1] / vertices_per_strand + 1,
                      real(at + 2),
                      {real(at + 4), real(at + 5), real(at + 6), real(at + 3)}});
}

}  // namespace

Result<std::vector<SeenShare>> shares_of_tiles(gpu::Device& device, const FineForm& form,
                                               std::vector<const gpu::Buffer*> bound, const tile_lists::TilePush& push,
                                               glm::uvec2 grid) {
  CUTICLE_ASSIGN(const gpu::Kernel kernel, device.make_kernel(code_of(form), fine_interface(form, 9, false)));
  const std::size_t bytes = std::min<std::size_t>(k_max_bytes, device.info().max_storage_buffer_bytes);
  const std::size_t room = (bytes / sizeof(std::uint32_t) - k_head_words) / k_record_words;
  CUTICLE_ASSIGN(const gpu::Buffer records,
                 device.make_buffer((k_head_words + room * k_record_words) * sizeof(std::uint32_t)));
  bound.push_back(&records);
  std::vector<SeenShare> shares;
  const std::uint32_t texels = push.part.x * push.part.y;
  for (std::uint32_t first = 0, end = texels; first < texels;) {
    const std::uint32_t head[k_head_words] = {0, first, end, 0};
    gpu::Commands commands = device.record();
    commands.write(records, std::as_bytes(std::span(head)));
    commands.dispatch(kernel, bound, {}, gpu::bytes_of(push), grid.x, grid.y);
    CUTICLE_TRY(device.submit(std::move(commands)));
    CUTICLE_ASSIGN(const auto told, gpu::read_buffer<std::uint32_t>(device, records, k_head_words));
    if (told[0] > room) {
      end = first + (end - first) / 2;
      continue;
    }
    CUTICLE_ASSIGN(const auto words,
                   gpu::read_buffer<std::uint32_t>(device, records, k_head_words + told[0] * k_record_words));
    append(shares, words, push.vertices_per_strand);
    first = end;
    end = texels;
  }
  return shares;
}

}  // namespace cuticle::render::tiles
