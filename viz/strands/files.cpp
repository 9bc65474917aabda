// What the view of strands shows, as files for ParaView.
#include <filesystem>

#include <fmt/format.h>

#include "core/file.h"
#include "strands/formats/vtp/vtp.h"
#include "viz/files/paraview_state.h"
#include "viz/files/vtk_xml.h"
#include "viz/strands/states.h"

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

Result<void> write_run(const StrandsView& view, const Run& run, const std::string& folder) {
  const int frame = std::min(view.frame, int(run.frames.size()) - 1);
  CUTICLE_ASSIGN(const strands::Groom groom, read_frame(run, frame, view.metres_per_unit));
  CUTICLE_ASSIGN(const ColoredStrands colored, color_strands(groom, view.coloring));
  const std::string array = file_safe(view.coloring.name.empty() ? "color" : view.coloring.name);
  const std::string stem = std::filesystem::path(run.name).stem().string();
  const std::string lines = fmt::format("strands_{}.vtp", stem), series = fmt::format("run_{}.pvd", stem);
  CUTICLE_TRY(write_text_file(folder + "/" + lines,
                              format_lines(groom.offsets, groom.positions, arrays_of(groom, colored, array))));
  const bool is_series = run.frames.size() > 1 && groom.attributes.contains(view.coloring.name);
  if (run.frames.size() > 1) CUTICLE_TRY(write_text_file(folder + "/" + series, series_of(run, folder)));
  return write_text_file(fmt::format("{}/paraview_{}.py", folder, stem),
                         paraview_state(is_series ? series : lines, array, scale_of(colored)));
}

}  // namespace

Result<void> write_strands(const StrandsView& view, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  for (const Run& run : view.runs) CUTICLE_TRY(write_run(view, run, folder));
  return {};
}

}  // namespace cuticle::viz
