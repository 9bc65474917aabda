#pragma once
// A grooming specification (JSON, docs/grooming.schema.json): everything that `cuticle grow` makes hair from.
#include <string>
#include <string_view>

#include "strands/growing/growing.h"
#include "strands/shaping/shaping.h"
#include "strands/spline/smooth.h"

namespace cuticle::strands {

/// What carries hair.
enum class HairSurface { scalp, head };
/// Number, place, curve and interpolation of drawn strands.
struct StrandParameters {
  HairSurface surface = HairSurface::scalp;
  int control_hairs = 300, vertices = 30;
  double density = 1e5, share = 1, hairline = 0;
  RootRule roots = RootRule::folded;
  Curve curve = Curve::bezier;
  bool nearest_hair = false;  ///< strands follow the nearest control hair; else they are mixed from three
  std::uint64_t seed = 1;
};
void describe(registry::Members& members, StrandParameters& strands);

/// Validated; what the file leaves out has its default.
struct GroomingSpecification {
  std::string name;
  Style growing;             ///< control hairs
  StrandParameters strands;  ///< drawn strands
  Grooming grooming;         ///< "regions", "strokes", "bun"
  ShapingBlocks shaping;     ///< effects by name; none runs that is not named
};

/// From a JSON object with "schema_version": 1 and any of the keys above. Error: bad_input naming `where`, key, value
/// and range; an unknown key is refused with the nearest known one.
Result<GroomingSpecification> parse_specification(std::string_view json, const std::string& where);
Result<GroomingSpecification> load_specification(const std::string& path);

/// The JSON Schema (draft 7), written from the tables.
std::string specification_schema();

}  // namespace cuticle::strands
