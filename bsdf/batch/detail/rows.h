#pragma once
// Parameters that change from point to point: arrays of the caller for some, a constant spread over a block for the
// others.
#include <array>
#include <vector>

#include <cuticle/bsdf/batch/batch.h>
#include <cuticle/bsdf/batch/kernel.h>

namespace cuticle::bsdf::batch {

/// Pointers for one block, and the constants that they point to.
struct RowBlock {
  RowPointers pointers{};
  std::vector<float> constants;
};

/// The columns of ParameterRow, in the order of the model's parameters; an rgb counts as three, "sigma_a.r", ".g",
/// ".b".
class RowColumns {
 public:
  /// `numbers`: the leading columns, those that the model reads. Error: usage, where a name is none of them, listing
  /// them.
  static Result<RowColumns> make(const Model& model, const registry::ParameterValues& values, int numbers,
                                 std::span<const VaryingParameter> varying);
  RowBlock block(std::size_t first, std::size_t count) const;

 private:
  std::array<std::span<const float>, CUTICLE_ROW_COUNT> arrays_;  ///< empty: constant
  std::array<float, CUTICLE_ROW_COUNT> constants_{};
  std::size_t count_ = 0;
};

}  // namespace cuticle::bsdf::batch
