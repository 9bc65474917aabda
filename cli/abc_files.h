#pragma once
// Alembic curves with Unreal's groom schema, by Python's alembic3d (python/cuticle_abc).
#include <string>
#include <vector>

#include "strands/formats/formats.h"
#include "strands/refusals.h"

namespace cuticle::cli {

/// Metres of a unit in the .abc that are written unless another is asked for: Unreal's and Maya's centimetre.
inline constexpr double k_abc_unit = 0.01;

bool is_abc(const std::string& path);

/// The curves of every object as one groom, transformations applied, the first sample of what moves. Unit: as asked
/// for, else as a file of ours states, else guessed. Error: bad_input naming the file, and what to install where Python
/// or alembic3d is missing.
Result<strands::GroomFile> read_abc(const std::string& path, const strands::ReadOptions& options);
/// Everything that a groom holds, as `groom_NAME`. `metres_per_unit` > 0.
Result<void> write_abc(const std::string& path, const strands::Groom& groom, double metres_per_unit);

/// What Unreal's groom schema (version 1.5) says of a file: what its importer refuses, and what it fills in.
struct AbcSchema {
  std::vector<strands::Refusal> refuses, fills_in;
};
Result<AbcSchema> check_abc(const std::string& path);

}  // namespace cuticle::cli
