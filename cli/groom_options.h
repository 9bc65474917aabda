#pragma once
// What every command that reads a groom does in the same way.
#include "cli/command.h"
#include "strands/formats/formats.h"

namespace cuticle::cli {

/// --metres-per-unit and --radius, into the numbers given; 0 = not given.
void add_groom_options(CLI::App& command, double& metres_per_unit, double& radius);

/// The groom in a file; what was guessed goes to `progress`. Errors: as strands::read_groom.
Result<strands::Groom> load_groom(const std::string& file, const strands::ReadOptions& options, Progress& progress);

/// "groom: .hair, .tfx, ..": the help of an option that names a file to read or to write.
std::string groom_help(bool to_write);

/// The strand that reaches farthest from the median of all points, metres. The groom must have points.
struct FarStrand {
  std::size_t strand = 0;
  double distance = 0;
};
FarStrand farthest_strand(const strands::Groom& groom);

}  // namespace cuticle::cli
