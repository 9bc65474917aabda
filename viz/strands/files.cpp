// What the view of strands shows, as files for ParaView.
#include <filesystem>

#include <fmt/format.h>

#include "core/file.h"
#include "strands/formats/vtp/vtp.h"
#include "viz/files/paraview_state.h"
#include "viz/files/vtk_xml.h"
#include "viz/strands/states.h"
#include "viz/strands/surroundings.h"

namespace cuticle::viz {
namespace {

/// The colours' numbers first, then the file's own arrays.
std::vector<NamedArray> arrays_of(const strands::Groom& groom, const ColoredStrands& colored, const std::string& name) {
  std::vector<NamedArray> arrays = {{name, colored.title, 1, colored.values},
                                    {"arc_length", "m", 1, arc_lengths(groom)}};
  for (const auto& [attribute, values] : groom.attributes)
    if (values.domain == strands::Attribute::Domain::vertex && attribute != name)
      arrays.push_back({attribute, std::string(strands::state_unit(attribute)), values.components, values.values});
  return arrays;
}

std::string series_of(const Run& run, const std::string& folder) {
  std::vector<strands::SeriesMember> members;
  for (const RunFrame& frame : run.frames)
    members.push_back({frame.time, std::filesystem::proximate(frame.file, folder).string()});
  return strands::format_pvd(members);
}

std::string file_safe(std::string name) {
  for (char& c : name)
    if (c == ':' || c == '/') c = '_';
  return name;
}

/// Colliders with surfaces in one file, distance fields each in its own.
Result<void> write_colliders(const StrandsView& view, const Run& run, int frame, const std::string& folder,
                             const std::string& stem) {
  std::vector<sim::PlacedCollider> colliders = run.colliders_at(frame);
  for (const Sphere& sphere : view.coloring.colliders) colliders.push_back({sphere, {}});
  strands::Mesh all;
  for (std::size_t k = 0; k < colliders.size(); ++k) {
    if (const auto* field = std::get_if<sim::FieldPointer>(&colliders[k].shape)) {
      CUTICLE_TRY(write_text_file(fmt::format("{}/field_{}_{}.vti", folder, stem, k),
                                  format_field(**field, colliders[k].place)));
      continue;
    }
    const strands::Mesh mesh = surface_of(colliders[k]);
    const auto first = std::uint32_t(all.positions.size());
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
    for (const auto& t : mesh.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  if (all.triangles.empty()) return {};
  return write_text_file(fmt::format("{}/colliders_{}.vtp", folder, stem),
                         format_triangles(all.positions, all.normals, all.triangles));
}

Result<void> write_density(const strands::Groom& groom, double cell, const std::string& file) {
  CUTICLE_ASSIGN(VolumeGrid density, hair_density(groom, cell));
  const NamedArray values{"density", "mm/mm^3", 1, std::move(density.values)};
  return write_text_file(file, format_vti(density.size, density.origin, glm::dvec3(density.spacing), {&values, 1}));
}

/// Of a run's files; two runs of one name have their numbers in it.
std::string stem_of(const StrandsView& view, std::size_t run) {
  const auto stem = [&](std::size_t k) { return std::filesystem::path(view.runs[k].name).stem().string(); };
  const bool alone = view.runs.size() < 2 || stem(0) != stem(1);
  return file_safe(alone ? stem(run) : fmt::format("{}_{}", stem(run), run + 1));
}

Result<void> write_run(const StrandsView& view, std::size_t which, const std::string& folder) {
  const Run& run = view.runs[which];
  const int frame = std::min(view.frame, int(run.frames.size()) - 1);
  CUTICLE_ASSIGN(const strands::Groom groom, read_frame(run, frame, view.metres_per_unit));
  CUTICLE_ASSIGN(const ColoredStrands colored, color_strands(groom, view.coloring));
  const std::string array = file_safe(view.coloring.name.empty() ? "color" : view.coloring.name);
  const std::string stem = stem_of(view, which);
  const std::string lines = fmt::format("strands_{}.vtp", stem), series = fmt::format("run_{}.pvd", stem);
  CUTICLE_TRY(write_text_file(folder + "/" + lines,
                              format_lines(groom.offsets, groom.positions, arrays_of(groom, colored, array))));
  CUTICLE_TRY(write_colliders(view, run, frame, folder, stem));
  if (view.density_cell > 0)
    CUTICLE_TRY(write_density(groom, view.density_cell, fmt::format("{}/density_{}.vti", folder, stem)));
  const bool is_series = run.frames.size() > 1 && groom.attributes.contains(view.coloring.name);
  if (run.frames.size() > 1) CUTICLE_TRY(write_text_file(folder + "/" + series, series_of(run, folder)));
  return write_text_file(fmt::format("{}/paraview_{}.py", folder, stem),
                         paraview_state(is_series ? series : lines, array, scale_of(colored)));
}

}  // namespace

Result<void> write_strands(const StrandsView& view, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  for (std::size_t k = 0; k < view.runs.size(); ++k) CUTICLE_TRY(write_run(view, k, folder));
  return {};
}

}  // namespace cuticle::viz
