#pragma once
// Grooms of every file that the program takes: the formats of strands, and those that Python's usd-core or alembic3d
// open.
#include <string>
#include <vector>

#include "strands/formats/formats.h"

namespace cuticle::cli {

/// As strands::read_groom; also .usd, .usdc, .usdz and .abc (abc_files.h). Error: bad_input naming the file, and what
/// to install where Python, usd-core or alembic3d is missing.
Result<strands::GroomFile> read_groom_file(const std::string& path, const strands::ReadOptions& options);
/// As strands::write_groom; also .usd, .usdc, .abc and, as lines, .glb. `metres_per_unit` 0: the format's own, metres
/// or k_abc_unit.
Result<std::vector<std::string>> write_groom_file(const std::string& path, const strands::Groom& groom,
                                                  double metres_per_unit = 0);

}  // namespace cuticle::cli
