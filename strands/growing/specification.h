#pragma once
// A grooming specification (JSON, docs/grooming.schema.json): everything that `cuticle grow` makes hair from.
#include <string>
#include <string_view>

#include "strands/growing/growing.h"
#include "strands/shaping/shaping.h"

namespace cuticle::strands {

/// Validated; what the file leaves out has its default.
struct GroomingSpecification {
  std::string name;
  registry::ParameterValues growing;  ///< of growing_parameters(): control hairs
  registry::ParameterValues strands;  ///< of strand_parameters(): drawn strands
  Grooming grooming;                  ///< "regions", "strokes", "bun"
  ShapingBlocks shaping;              ///< effects by name; none runs that is not named
};

/// Number, place, curve and interpolation of drawn strands.
registry::ParameterTable strand_parameters();

/// All defaults, no grooming, no shaping.
GroomingSpecification default_specification();

/// From a JSON object with "schema_version": 1 and any of the keys above. Error: bad_input naming `where`, key, value
/// and range; an unknown key is refused with the nearest known one.
Result<GroomingSpecification> parse_specification(std::string_view json, const std::string& where);
Result<GroomingSpecification> load_specification(const std::string& path);

/// The JSON Schema (draft 7), written from the tables.
std::string specification_schema();

}  // namespace cuticle::strands
