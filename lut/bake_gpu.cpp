#include "lut/bake_gpu.h"

#include <bit>
#include <chrono>

#include "core/wall_clock.h"
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

Result<void> DeviceBaker::compile(std::vector<const TableLayout*> layouts) {
  CUTICLE_ASSIGN(kernel_, BakeKernel::make(*device_, *model_, std::move(layouts), size_));
  CUTICLE_ASSIGN(texels_, device_->make_buffer(kernel_->bytes()));
  return {};
}

/// The tables that the device makes, filled from its buffer.
Result<void> DeviceBaker::fill(TableSet& set) {
  std::vector<const TableLayout*> layouts;
  for (const Table& table : set.tables)
    if (is_baked_on_device(*table.layout)) layouts.push_back(table.layout);
  if (layouts.empty()) return {};
  if (!kernel_) CUTICLE_TRY(compile(std::move(layouts)));
  gpu::Commands commands = device_->record();
  commands.begin_pass("bake tables");
  kernel_->record(commands, set.values, texels_);
  commands.end_pass();
  CUTICLE_ASSIGN(cost_, device_->submit(std::move(commands)));
  CUTICLE_ASSIGN(const std::vector<std::uint32_t> words,
                 gpu::read_buffer<std::uint32_t>(*device_, texels_, kernel_->bytes() / 4));
  std::size_t at = 0;
  for (Table& table : set.tables)
    if (is_baked_on_device(*table.layout)) {
      take_texels(table, words, at);
      suit_to_filter(table);
    }
  return {};
}

Result<TableSet> DeviceBaker::bake(const registry::ParameterValues& values) {
  CUTICLE_TRY(check_size(size_));
  const auto start = std::chrono::steady_clock::now();
  const registry::ParameterValues held = table_values(*model_, values, *layout_);
  const Source source = cpu_source(*model_, held);
  CUTICLE_TRY(check_bakeable(source, held, *layout_));
  TableSet set;
  set.layout = layout_;
  set.model = model_;
  set.values = held;
  set.size = size_;
  for (const TableLayout& table : layout_->tables) {
    if (is_baked_on_device(table)) {
      set.tables.push_back(empty_table(table, size_));
      set.tables.back().caustic_index = source.caustic_index;
    } else {
      CUTICLE_ASSIGN(set.tables.emplace_back(), bake_table(source, table, size_));
    }
  }
  CUTICLE_TRY(fill(set));
  if (layout_->solve) CUTICLE_TRY(layout_->solve(source, set, silent_progress()));
  set.bake_ms = milliseconds_since(start);
  set.baked_on = device_->info().name;
  return set;
}

Result<TableSet> bake_gpu(gpu::Device& device, const bsdf::Model& model, const registry::ParameterValues& values,
                          const Layout& layout, int size) {
  return DeviceBaker(device, model, layout, size).bake(values);
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
