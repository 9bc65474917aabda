#pragma once
// Private to lut's GPU half: the kernel of bake.comp with everything on the device that parameters do not change.
#include "gpu/device.h"
#include "lut/table_set.h"

namespace cuticle::lut {

/// A model's bake.comp, compiled (SPIR-V, embedded).
struct BakeShader {
  std::string_view model;
  std::span<const std::uint32_t> spirv;
};
std::span<const BakeShader> bake_shaders();

/// What a texel becomes: four halves, as a texture takes them, or four floats and a flag for a caustic.
enum class TexelWords : std::uint32_t { halves = 2, floats_and_flag = 5 };

/// Whether bake.comp makes every channel of a table: M, N and means of N of the model, and cos theta_d.
bool is_baked_on_device(const TableLayout& table);

/// The texels of some tables of one size, one table after the other.
class BakeKernel {
 public:
  /// Error: usage for a size that bake refuses, a lobe that the model lacks, or a model without a kernel.
  static Result<BakeKernel> make(gpu::Device& device, const bsdf::Model& model, std::vector<const TableLayout*> tables,
                                 int size, TexelWords words);
  /// Records the bake into the buffer, which has bytes() bytes.
  void record(gpu::Commands& commands, const registry::ParameterValues& values, const gpu::Buffer& texels) const;
  std::size_t bytes() const;
  /// Where a table begins in the buffer.
  std::size_t offset_of(std::size_t table) const { return first_texels_[table] * std::size_t(words_) * 4; }

 private:
  BakeKernel() = default;
  Result<void> describe(gpu::Device& device, int size);

  const bsdf::Model* model_ = nullptr;
  std::vector<const TableLayout*> tables_;
  TexelWords words_ = TexelWords::halves;
  gpu::Kernel kernel_;
  gpu::Buffer parameters_, table_records_, points_;
  std::vector<std::size_t> first_texels_;  ///< of each table, and the end
  std::uint32_t groups_ = 0;
};

}  // namespace cuticle::lut
