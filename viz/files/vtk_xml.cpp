#include "viz/files/vtk_xml.h"

#include <cmath>
#include <cstdint>
#include <iterator>

#include <fmt/format.h>

namespace cuticle::viz {
namespace {

using Text = fmt::memory_buffer;

void append(Text& text, std::string_view words) { text.append(words.data(), words.data() + words.size()); }

void append_array(Text& text, const NamedArray& array) {
  fmt::format_to(std::back_inserter(text),
                 "<DataArray type=\"Float32\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", array.name,
                 array.components);
  for (std::size_t i = 0; i < array.values.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{:.9g}{}", array.values[i], i % 12 == 11 ? '\n' : ' ');
  append(text, "\n");
  // After the numbers: VTK reads those up to the first element.
  if (!array.unit.empty())
    fmt::format_to(std::back_inserter(text),
                   "<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>\n", array.unit);
  append(text, "</DataArray>\n");
}

void append_point_data(Text& text, std::span<const NamedArray> arrays) {
  append(text, "<PointData");
  if (!arrays.empty()) fmt::format_to(std::back_inserter(text), " Scalars=\"{}\"", arrays.front().name);
  append(text, ">\n");
  for (const NamedArray& array : arrays) append_array(text, array);
  append(text, "</PointData>\n");
}

void append_points(Text& text, std::span<const glm::vec3> points) {
  NamedArray array{"Points", "m", 3, {}};
  for (const glm::vec3& p : points) array.values.insert(array.values.end(), {p.x, p.y, p.z});
  append(text, "<Points>\n");
  append_array(text, array);
  append(text, "</Points>\n");
}

void begin(Text& text, std::string_view type) {
  fmt::format_to(std::back_inserter(text),
                 "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"0.1\" byte_order=\"LittleEndian\">\n", type);
}

std::string extent(const glm::ivec3& size) { return fmt::format("0 {} 0 {} 0 {}", size.x - 1, size.y - 1, size.z - 1); }

}  // namespace

std::string format_vts(const glm::ivec3& size, std::span<const glm::vec3> points, std::span<const NamedArray> arrays) {
  Text text;
  begin(text, "StructuredGrid");
  fmt::format_to(std::back_inserter(text), "<StructuredGrid WholeExtent=\"{0}\">\n<Piece Extent=\"{0}\">\n",
                 extent(size));
  append_point_data(text, arrays);
  append_points(text, points);
  append(text, "</Piece>\n</StructuredGrid>\n</VTKFile>\n");
  return fmt::to_string(text);
}

std::string format_vti(const glm::ivec3& size, const glm::dvec3& origin, const glm::dvec3& spacing,
                       std::span<const NamedArray> arrays, const glm::dmat3& axes) {
  Text text;
  begin(text, "ImageData");
  fmt::format_to(std::back_inserter(text), "<ImageData WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\"",
                 extent(size), origin.x, origin.y, origin.z, spacing.x, spacing.y, spacing.z);
  if (axes != glm::dmat3(1))
    fmt::format_to(std::back_inserter(text), " Direction=\"{} {} {} {} {} {} {} {} {}\"", axes[0].x, axes[1].x,
                   axes[2].x, axes[0].y, axes[1].y, axes[2].y, axes[0].z, axes[1].z, axes[2].z);
  fmt::format_to(std::back_inserter(text), ">\n<Piece Extent=\"{}\">\n", extent(size));
  append_point_data(text, arrays);
  append(text, "</Piece>\n</ImageData>\n</VTKFile>\n");
  return fmt::to_string(text);
}

std::string format_triangles(std::span<const glm::vec3> points, std::span<const glm::vec3> normals,
                             std::span<const std::array<std::uint32_t, 3>> triangles) {
  Text text;
  begin(text, "PolyData");
  fmt::format_to(std::back_inserter(text),
                 "<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
                 "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
                 points.size(), triangles.size());
  NamedArray array{"normal", "", 3, {}};
  for (const glm::vec3& n : normals) array.values.insert(array.values.end(), {n.x, n.y, n.z});
  append_point_data(text, {&array, 1});
  append_points(text, points);
  append(text, "<Polys>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
  for (const auto& t : triangles) fmt::format_to(std::back_inserter(text), "{} {} {}\n", t[0], t[1], t[2]);
  append(text, "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n");
  for (std::size_t k = 1; k <= triangles.size(); ++k) fmt::format_to(std::back_inserter(text), "{}\n", 3 * k);
  append(text, "</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n");
  return fmt::to_string(text);
}

std::string format_lines(std::span<const std::uint32_t> offsets, std::span<const glm::vec3> points,
                         std::span<const NamedArray> arrays) {
  Text text;
  begin(text, "PolyData");
  fmt::format_to(std::back_inserter(text),
                 "<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" "
                 "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
                 points.size(), offsets.size() - 1);
  append_point_data(text, arrays);
  append_points(text, points);
  append(text, "<Lines>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
  for (std::size_t i = 0; i < points.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{}{}", i, i % 16 == 15 ? '\n' : ' ');
  append(text, "\n</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n");
  for (std::size_t s = 1; s < offsets.size(); ++s)
    fmt::format_to(std::back_inserter(text), "{}{}", offsets[s], s % 16 == 15 ? '\n' : ' ');
  append(text, "\n</DataArray>\n</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n");
  return fmt::to_string(text);
}

}  // namespace cuticle::viz
