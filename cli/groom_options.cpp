#include "cli/groom_options.h"

#include "cli/usd_files.h"

namespace cuticle::cli {

void add_groom_options(CLI::App& command, double& metres_per_unit, double& radius) {
  command.add_option("--metres-per-unit", metres_per_unit, "unit of the groom file; 0 = guess and say so")
      ->check(CLI::Range(0.0, 1000.0));
  command.add_option("--radius", radius, "fibre radius in metres; 0 = the file's own or 35e-6")
      ->check(CLI::Range(0.0, 0.01));
}

Result<strands::Groom> load_groom(const std::string& path, const strands::ReadOptions& options, Progress& progress) {
  CUTICLE_ASSIGN(auto file, read_groom_file(path, options));
  for (const std::string& note : file.notes) progress.message(note);
  return std::move(file.groom);
}

std::string groom_help(bool to_write) {
  return "groom: " + strands::list_of_extensions(to_write) + (to_write ? ", .usd, .usdc (usd-core)" : ", .usd, .usdc, .usdz, .abc (usd-core)");
}

}  // namespace cuticle::cli
