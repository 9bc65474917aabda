#include "lut/bake_kernel_gpu.h"

#include <algorithm>

#include <fmt/format.h>

#include "gpu/groups.h"
#include "lut/cell_average.h"

namespace cuticle::lut {
namespace {

constexpr std::size_t k_channels = 4;

/// As in bake.comp.
enum class TermKind : std::int32_t { none = -1, value = 0, mean = 1, cos_theta_d = 2 };
struct Term {
  TermKind kind = TermKind::none;
  std::int32_t quantity = 0, lobes = 0, unused = 0;
};
struct TableRecord {
  std::uint32_t first = 0, count = 0, from_caustic = 0, unused = 0;
  std::array<Term, k_channels> terms{};
  std::array<std::int32_t, k_channels> term_of_channel{-1, -1, -1, -1}, component_of_channel{};
};
struct TexelPoint {
  float theta_i, theta_o, theta_d, phi, h, phi_o, begin, end;
};
static_assert(sizeof(Term) == 16 && sizeof(TableRecord) == 112 && sizeof(TexelPoint) == 32);

Result<Term> term_of(const bsdf::Model& model, const Channel& channel) {
  if (channel.source == ChannelSource::cos_theta_d) return Term{TermKind::cos_theta_d};
  Term term{channel.texel == Texel::cell_average ? TermKind::mean : TermKind::value, std::int32_t(channel.quantity)};
  CUTICLE_ASSIGN(const std::vector<int> lobes, find_lobes(model, channel.lobe));
  for (int lobe : lobes) term.lobes |= 1 << lobe;
  return term;
}

/// Neighbouring channels that differ in the colour only share a term.
Result<void> add_channels(TableRecord& record, const bsdf::Model& model, std::span<const Channel> channels) {
  std::int32_t term = -1;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (c == 0 || !same_lobes(channels[c - 1], channels[c])) {
      CUTICLE_ASSIGN(record.terms[std::size_t(++term)], term_of(model, channels[c]));
    }
    record.term_of_channel[c] = term;
    record.component_of_channel[c] = channels[c].component;
  }
  return {};
}

bool has_means(const TableLayout& table) {
  return std::ranges::any_of(table.channels, [](const Channel& c) { return c.texel == Texel::cell_average; });
}

bool is_from_caustic(const TableLayout& table) { return table.u.quantity == AxisQuantity::from_caustic; }

/// Beside a caustic phi is the axis' value and begin its gap: the kernel knows the parameters, and so the caustic's
/// place.
TexelPoint point_of(const TableLayout& table, glm::ivec2 texels, int x, int y) {
  const double u = (x + 0.5) / texels.x, v = (y + 0.5) / texels.y;
  const double u_value = axis_value(table.u, texels.x, u), v_value = axis_value(table.v, texels.y, v);
  if (is_from_caustic(table)) return {0, 0, float(v_value), float(u_value), 0, 0, float(1.0 / (texels.x - 1)), 0};
  const bsdf::Point at = make_point(table, u_value, v_value);
  TexelPoint point{
      float(at.theta_i), float(at.theta_o), float(at.theta_d), float(at.phi), float(at.h), float(at.phi_o), 0, 0};
  if (!has_means(table)) return point;
  const PhiInterval cell = phi_interval(table, texels.x, double(x) / texels.x, (x + 1.0) / texels.x, v);
  point.begin = float(cell.begin);
  point.end = float(cell.end);
  return point;
}

std::span<const std::uint32_t> shader_of(const bsdf::Model& model) {
  for (const BakeShader& shader : bake_shaders())
    if (shader.model == model.entry.name) return shader.spirv;
  return {};
}

}  // namespace

bool is_baked_on_device(const TableLayout& table) {
  const auto is_made = [](const Channel& channel) {
    if (channel.source == ChannelSource::cos_theta_d) return true;
    return channel.source == ChannelSource::model &&
           (channel.quantity == bsdf::Quantity::M || channel.quantity == bsdf::Quantity::N);
  };
  return table.channels.size() <= k_channels && std::ranges::all_of(table.channels, is_made);
}

Result<BakeKernel> BakeKernel::make(gpu::Device& device, const bsdf::Model& model,
                                    std::vector<const TableLayout*> tables, int size) {
  CUTICLE_TRY(check_size(size));
  const std::span<const std::uint32_t> spirv = shader_of(model);
  if (spirv.empty()) return usage_error(fmt::format("model {} has no GPU kernel", model.entry.name), "--on cpu");
  BakeKernel made;
  made.model_ = &model;
  made.tables_ = std::move(tables);
  CUTICLE_ASSIGN(made.kernel_, device.make_kernel(spirv, {.storage_buffers = 4, .push_constant_bytes = sizeof(float)}));
  CUTICLE_TRY(made.describe(device, size));
  return made;
}

Result<void> BakeKernel::describe(gpu::Device& device, int size) {
  std::vector<TableRecord> records;
  std::vector<TexelPoint> points;
  for (const TableLayout* table : tables_) {
    const glm::ivec2 texels = table_size(*table, size);
    TableRecord& record = records.emplace_back();
    record.first = std::uint32_t(points.size());
    record.count = std::uint32_t(texels.x * texels.y);
    record.from_caustic = is_from_caustic(*table) ? 1 : 0;
    groups_ = std::max(groups_, gpu::groups_for(record.count).x);
    CUTICLE_TRY(add_channels(record, *model_, table->channels));
    for (int y = 0; y < texels.y; ++y)
      for (int x = 0; x < texels.x; ++x) points.push_back(point_of(*table, texels, x, y));
  }
  texels_ = points.size();
  CUTICLE_ASSIGN(
      parameters_,
      device.make_buffer(model_->pack(registry::default_values(model_->entry.parameters)).size() * sizeof(float)));
  CUTICLE_ASSIGN(table_records_, gpu::make_buffer_from<TableRecord>(device, records));
  CUTICLE_ASSIGN(points_, gpu::make_buffer_from<TexelPoint>(device, points));
  return {};
}

std::size_t BakeKernel::bytes() const { return texels_ * k_texel_words * 4; }

void BakeKernel::record(gpu::Commands& commands, const registry::ParameterValues& values,
                        const gpu::Buffer& texels) const {
  const std::vector<float> packed = model_->pack(values);
  commands.write(parameters_, std::as_bytes(std::span(packed)));
  const double index = model_->caustic_index ? model_->caustic_index(values) : 0;
  const float glass = float(index * index - 1);
  commands.dispatch(kernel_, {&parameters_, &table_records_, &points_, &texels}, {}, gpu::bytes_of(glass), groups_,
                    std::uint32_t(tables_.size()));
}

}  // namespace cuticle::lut
