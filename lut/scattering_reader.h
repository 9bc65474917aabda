#pragma once
// S put together from tables as a shader does.
#include <array>
#include <vector>

#include "lut/table_set.h"

namespace cuticle::lut {

inline constexpr std::string_view k_colours = "rgb";

/// A factor of a term for one colour: the channel of that name, or of that name with the colour's suffix.
struct FactorPlace {
  const Table* table = nullptr;
  int channel = 0;
  const Channel& layout() const { return table->layout->channels[channel]; }
};
/// Factors of all terms of the layout, those of one term after another, an empty place after each.
std::vector<FactorPlace> places_of(const TableSet& set, int colour);
/// The sum of the terms' products of what `value` gives for a place.
template <class Value>
double composed(const std::vector<FactorPlace>& places, const Value& value) {
  double sum = 0, product = 1;
  for (const FactorPlace& place : places) {
    if (place.table) {
      product *= value(place);
    } else {
      sum += product;
      product = 1;
    }
  }
  return sum;
}
/// Whether a table's channel has this source.
bool has_source(const TableSet& set, ChannelSource source);

/// Reads the tables as a shader does: theta_d through the table that stores its cosine, where one does. The set, whose
/// layout has terms, must outlive it. Test: certify_scattering, by lut_certify_test; reference_test.
class ScatteringReader {
 public:
  explicit ScatteringReader(const TableSet& set);
  /// S [1/sr] of one colour (0, 1, 2), without the cosine of theta_i, at theta_i, theta_o, theta_d =
  /// |theta_o - theta_i| / 2 and phi in [0, pi].
  double scattering(bsdf::Point at, int colour) const;
  /// What the shader divides the sum of the terms by.
  double divisor(const bsdf::Point& at) const;
  /// Whether a texel on a caustic is among those that the filter reads.
  bool filters_singular(const bsdf::Point& at) const;

 private:
  bsdf::Point as_stored(bsdf::Point at) const;
  glm::dvec2 coordinates(const Table& table, const bsdf::Point& at) const;

  const TableSet& set_;
  FactorPlace cosine_;
  std::array<std::vector<FactorPlace>, 3> places_;
};

}  // namespace cuticle::lut
