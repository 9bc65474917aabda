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

/// Of a texel: four floats, and whether a caustic lies inside.
inline constexpr std::size_t k_texel_words = 5;

/// Whether bake.comp makes every channel of a table: M, N and means of N of the model, and cos theta_d.
bool is_baked_on_device(const TableLayout& table);

/// The texels of some tables of one size, one table after the other.
class BakeKernel {
 public:
  /// Error: usage for a size that bake refuses, a lobe that the model lacks, or a model without a kernel.
  static Result<BakeKernel> make(gpu::Device& device, const bsdf::Model& model, std::vector<const TableLayout*> tables,
                                 int size);
  /// Records the bake into the buffer, which has bytes() bytes.
  void record(gpu::Commands& commands, const registry::ParameterValues& values, const gpu::Buffer& texels) const;
  std::size_t bytes() const;

 private:
  BakeKernel() = default;
  Result<void> describe(gpu::Device& device, int size);

  const bsdf::Model* model_ = nullptr;
  std::vector<const TableLayout*> tables_;
  gpu::Kernel kernel_;
  gpu::Buffer parameters_, table_records_, points_;
  std::size_t texels_ = 0;
  std::uint32_t groups_ = 0;
};

}  // namespace cuticle::lut
