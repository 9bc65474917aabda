#pragma once
// Parameters that change from point to point: arrays of the caller for some, a constant spread over a block once for
// the others.
#include <array>
#include <vector>

#include "bsdf/batch/batch.h"
#include "bsdf/batch/kernel.h"

namespace cuticle::bsdf::batch {

constexpr std::size_t row_block = 256;  ///< points of a block: its arrays stay in the nearest cache

/// The columns of the model's Varying, in the order of the model's parameters; an rgb counts as three, "sigma_a.r",
/// ".g",
/// ".b".
class RowColumns {
 public:
  /// `numbers`: the leading columns, those that the model reads. Error: usage, where a name is none of them, listing
  /// them.
  static Result<RowColumns> make(const Model& model, const registry::ParameterValues& values, int numbers,
                                 std::span<const VaryingParameter> varying);
  /// For the block of at most row_block points that begins at `first`.
  VaryingPointers block(std::size_t first) const;

 private:
  std::array<std::span<const float>, CUTICLE_VARYING_MOST> arrays_;  ///< empty: constant
  std::vector<float> constants_;                                  ///< row_block of each
  std::size_t count_ = 0;
};

}  // namespace cuticle::bsdf::batch
