#pragma once
// Grooms of every file that the program takes: the formats of strands, and what Python's usd-core turns into USD text.
#include <string>
#include <vector>

#include "strands/formats/formats.h"

namespace cuticle::cli {

/// As strands::read_groom; also .usd, .usdc, .usdz and, where Python's USD has its plug-in, .abc. Error: bad_input
/// naming the file, and what to install where Python or usd-core is missing.
Result<strands::GroomFile> read_groom_file(const std::string& path, const strands::ReadOptions& options);
/// As strands::write_groom; also .usd, .usdc and, as lines, .glb.
Result<std::vector<std::string>> write_groom_file(const std::string& path, const strands::Groom& groom,
                                                  double metres_per_unit = 1);

}  // namespace cuticle::cli
