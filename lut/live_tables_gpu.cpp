#include "lut/live_tables_gpu.h"

#include <utility>

#include <fmt/format.h>

#include "core/wall_clock.h"
#include "lut/evaluate.h"

namespace cuticle::lut {
namespace {

Result<std::vector<const TableLayout*>> device_tables(const Layout& layout) {
  std::vector<const TableLayout*> tables;
  for (const TableLayout& table : layout.tables) {
    if (!is_baked_on_device(table))
      return usage_error(fmt::format("layout {}: table {} is not made on the device", layout.entry.name, table.name),
                         "layout nalu");
    tables.push_back(&table);
  }
  return tables;
}

TableSet description_of(const bsdf::Model& model, const Layout& layout, int size) {
  TableSet set;
  set.layout = &layout;
  set.model = &model;
  set.size = size;
  for (const TableLayout& table : layout.tables) {
    set.tables.emplace_back().layout = &table;
    set.tables.back().scale.assign(table.channels.size(), 1.0);
  }
  return set;
}

}  // namespace

Result<LiveTables> LiveTables::make(gpu::Device& device, const bsdf::Model& model,
                                    const registry::ParameterValues& values, const Layout& layout, int size) {
  CUTICLE_ASSIGN(std::vector<const TableLayout*> tables, device_tables(layout));
  CUTICLE_ASSIGN(BakeKernel kernel, BakeKernel::make(device, model, std::move(tables), size, TexelWords::halves));
  LiveTables live(device, std::move(kernel));
  live.set_ = description_of(model, layout, size);
  live.set_.baked_on = device.info().name;
  CUTICLE_TRY(live.make_textures());
  CUTICLE_TRY(live.change(values));
  CUTICLE_TRY(live.finish());
  return live;
}

Result<void> LiveTables::make_textures() {
  CUTICLE_ASSIGN(texels_, device_->make_buffer(kernel_.bytes()));
  for (std::vector<gpu::Texture>& textures : textures_)
    for (const Table& table : set_.tables) {
      CUTICLE_ASSIGN(textures.emplace_back(), device_->make_texture({.size = table_size(*table.layout, set_.size)}));
    }
  return {};
}

Result<void> LiveTables::start(const registry::ParameterValues& values) {
  started_ = std::chrono::steady_clock::now();
  const std::vector<gpu::Texture>& back = textures_[1 - front_];
  gpu::Commands commands = device_->record();
  commands.begin_pass("rebake tables");
  kernel_.record(commands, values, texels_);
  for (std::size_t t = 0; t < back.size(); ++t) commands.copy(texels_, back[t], kernel_.offset_of(t));
  commands.end_pass();
  CUTICLE_ASSIGN(running_, device_->start(std::move(commands)));
  baking_ = values;
  cost_.host_ms = milliseconds_since(started_);
  return {};
}

Result<void> LiveTables::change(const registry::ParameterValues& values) {
  const registry::ParameterValues held = table_values(*set_.model, values, *set_.layout);
  CUTICLE_TRY(check_bakeable(cpu_source(*set_.model, held), held, *set_.layout));
  if (!running_) return start(held);
  waiting_ = held;
  return {};
}

Result<void> LiveTables::swap() {
  gpu::Running ended = std::move(*running_);
  running_.reset();
  CUTICLE_ASSIGN(const gpu::SubmitCost cost, ended.finish());
  cost_.device_ms = cost.passes[0].gpu_ms;
  cost_.dispatches = cost.passes[0].dispatches;
  cost_.latency_ms = milliseconds_since(started_);
  front_ = 1 - front_;
  set_.values = baking_;
  for (Table& table : set_.tables) table.caustic_index = cpu_source(*set_.model, baking_).caustic_index;
  set_.bake_ms = cost_.latency_ms;
  if (!waiting_) return {};
  return start(*std::exchange(waiting_, std::nullopt));
}

Result<bool> LiveTables::update() {
  if (!running_ || !running_->is_done()) return false;
  CUTICLE_TRY(swap());
  return true;
}

Result<void> LiveTables::finish() {
  while (running_) CUTICLE_TRY(swap());
  return {};
}

}  // namespace cuticle::lut
