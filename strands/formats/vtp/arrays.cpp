#include <iterator>
#include <utility>

#include <fmt/core.h>

#include "strands/formats/number_text.h"
#include "strands/formats/vtp/detail/arrays.h"
#include "strands/formats/vtp/vtp.h"

namespace cuticle::strands {

namespace {

void open_array(std::string& text, std::string_view type, std::string_view name, int components) {
  fmt::format_to(std::back_inserter(text),
                 "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type, name,
                 components);
}

}  // namespace

std::string_view state_unit(std::string_view array) {
  constexpr std::pair<std::string_view, std::string_view> units[] = {
      {"position", "m"},    {"velocity", "m/s"}, {"stretch", "1"}, {"tension", "m^2/s^2"},
      {"curvature", "1/m"}, {"radius", "m"},     {"contact", "m"}};
  for (const auto& [name, unit] : units)
    if (name == array) return unit;
  return {};
}

void append_array(std::string& text, std::string_view name, int components, std::span<const float> values) {
  open_array(text, "Float32", name, components);
  append_rows(text, values, std::size_t(components), {});
  // After the numbers: VTK reads those up to the first element.
  if (const std::string_view unit = state_unit(name); !unit.empty())
    fmt::format_to(std::back_inserter(text),
                   "<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>\n", unit);
  text += "</DataArray>\n";
}

void append_array(std::string& text, std::string_view name, std::span<const glm::vec3> values) {
  append_array(text, name, 3, {reinterpret_cast<const float*>(values.data()), 3 * values.size()});
}

void append_array(std::string& text, std::string_view type, std::string_view name,
                  std::span<const std::uint32_t> values) {
  open_array(text, type, name, 1);
  append_rows(text, values, 1, {});
  text += "</DataArray>\n";
}

std::size_t line_count(const Groom& groom) {
  std::size_t count = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) count += groom.strand_size(s) > 1;
  return count;
}

void append_lines(std::string& text, const Groom& groom) {
  std::vector<std::uint32_t> connectivity, ends;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    if (groom.strand_size(s) < 2) continue;
    for (std::uint32_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v) connectivity.push_back(v);
    ends.push_back(std::uint32_t(connectivity.size()));
  }
  append_array(text, "Int64", "connectivity", connectivity);
  append_array(text, "Int64", "offsets", ends);
}

std::string open_piece(std::size_t points, std::size_t lines) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfLines=\"{}\">\n",
      points, lines);
}

std::string_view close_piece() { return "</Piece>\n</PolyData>\n</VTKFile>\n"; }

}  // namespace cuticle::strands
