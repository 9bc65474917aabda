#include "lut/bake_gpu.h"

#include <bit>
#include <chrono>

#include "core/wall_clock.h"
#include "lut/bake_kernel_gpu.h"
#include "lut/evaluate.h"

namespace cuticle::lut {
namespace {

/// The next table's texels: four floats and a flag each.
void take_texels(Table& table, std::span<const std::uint32_t> words, std::size_t& at) {
  const std::size_t channels = table.scale.size();
  for (std::size_t i = 0; i < table.singular.size(); ++i, at += 5) {
    for (std::size_t c = 0; c < channels; ++c)
      table.image.pixels[i * channels + c] = std::bit_cast<float>(words[at + c]);
    table.singular[i] = std::uint8_t(words[at + 4]);
  }
}

/// The tables that the device makes, filled from its buffer.
Result<void> fill_on_device(gpu::Device& device, TableSet& set) {
  std::vector<const TableLayout*> layouts;
  for (const Table& table : set.tables)
    if (is_baked_on_device(*table.layout)) layouts.push_back(table.layout);
  if (layouts.empty()) return {};
  CUTICLE_ASSIGN(const BakeKernel kernel,
                 BakeKernel::make(device, *set.model, layouts, set.size, TexelWords::floats_and_flag));
  CUTICLE_ASSIGN(const gpu::Buffer texels, device.make_buffer(kernel.bytes()));
  gpu::Commands commands = device.record();
  commands.begin_pass("bake tables");
  kernel.record(commands, set.values, texels);
  commands.end_pass();
  CUTICLE_TRY(device.submit(std::move(commands)));
  CUTICLE_ASSIGN(const std::vector<std::uint32_t> words,
                 gpu::read_buffer<std::uint32_t>(device, texels, kernel.bytes() / 4));
  std::size_t at = 0;
  for (Table& table : set.tables)
    if (is_baked_on_device(*table.layout)) {
      take_texels(table, words, at);
      suit_to_filter(table);
    }
  return {};
}

/// Four floats a texel, values with their scale applied, missing channels 0.
std::vector<float> texels_of(const Table& table) {
  const int channels = table.image.channels();
  std::vector<float> texels(std::size_t(table.image.width) * table.image.height * 4, 0.0F);
  for (std::size_t i = 0; i < texels.size() / 4; ++i)
    for (int c = 0; c < channels; ++c)
      texels[i * 4 + c] = float(double(table.image.pixels[i * channels + c]) * table.scale[c]);
  return texels;
}

}  // namespace

Result<TableSet> bake_gpu(gpu::Device& device, const bsdf::Model& model, const registry::ParameterValues& values,
                          const Layout& layout, int size) {
  CUTICLE_TRY(check_size(size));
  const auto start = std::chrono::steady_clock::now();
  const registry::ParameterValues held = table_values(model, values, layout);
  const Source source = cpu_source(model, held);
  CUTICLE_TRY(check_bakeable(source, held, layout));
  TableSet set;
  set.layout = &layout;
  set.model = &model;
  set.values = held;
  set.size = size;
  for (const TableLayout& table : layout.tables) {
    if (is_baked_on_device(table)) {
      set.tables.push_back(empty_table(table, size));
      set.tables.back().caustic_index = source.caustic_index;
    } else {
      CUTICLE_ASSIGN(set.tables.emplace_back(), bake_table(source, table, size));
    }
  }
  CUTICLE_TRY(fill_on_device(device, set));
  if (layout.solve) CUTICLE_TRY(layout.solve(source, set, silent_progress()));
  set.bake_ms = milliseconds_since(start);
  set.baked_on = device.info().name;
  return set;
}

Result<std::vector<gpu::Texture>> upload(gpu::Device& device, const TableSet& set, bool mip_levels) {
  std::vector<gpu::Texture> textures;
  for (const Table& table : set.tables) {
    CUTICLE_ASSIGN(textures.emplace_back(),
                   device.make_texture({.size = {table.image.width, table.image.height}, .mip_levels = mip_levels}));
    CUTICLE_TRY(device.upload(textures.back(), texels_of(table)));
  }
  return textures;
}

}  // namespace cuticle::lut
