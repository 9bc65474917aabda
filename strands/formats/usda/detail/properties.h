#pragma once
// The BasisCurves prims of a USDA text, as their properties.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace cuticle::strands::usda {

/// A property's value: its numbers, brackets and parentheses flattened, or a token's text.
struct Property {
  std::string type;  ///< "point3f", of one value also of an array
  std::vector<double> numbers = {};
  std::string text = {};
  std::size_t element_size = 1;
  std::size_t components() const;  ///< numbers of one element: 3 for point3f, times element_size; 0 for no numbers
};

using Prim = std::map<std::string, Property, std::less<>>;

struct Stage {
  double metres_per_unit = 0;  ///< 0: not stated
  std::string up_axis;
  std::vector<Prim> curves;  ///< of every `def BasisCurves`
  bool has_samples = false;  ///< some value changes with time: only values without time are read
  bool has_transforms = false;
};

/// Error: bad_input naming the line: no "#usda", a list that is not closed or holds what is no number.
Result<Stage> parse_stage(std::string_view text, const std::string& where);

}  // namespace cuticle::strands::usda
