#include "cli/groom_options.h"

#include <algorithm>

#include <glm/geometric.hpp>

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

FarStrand farthest_strand(const strands::Groom& groom) {
  glm::vec3 middle(0);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    for (const glm::vec3& position : groom.positions) values.push_back(position[axis]);
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    middle[axis] = values[values.size() / 2];
  }
  FarStrand far;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (const glm::vec3& position : groom.strand(s))
      if (const double distance = glm::distance(glm::dvec3(position), glm::dvec3(middle)); distance > far.distance)
        far = {s, distance};
  return far;
}

std::string groom_help(bool to_write) {
  return "groom: " + strands::list_of_extensions(to_write) + (to_write ? ", .glb, .usd, .usdc (usd-core), .abc (alembic3d)" : ", .usd, .usdc, .usdz (usd-core), .abc (alembic3d)");
}

}  // namespace cuticle::cli
