#pragma once
// VTK's XML files of grids, written as text without VTK: what a view shows, for ParaView and PyVista.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace cuticle::viz {

/// One value, or three, a point. The unit goes into the file as VTK's own UNITS_LABEL.
struct NamedArray {
  std::string name, unit;
  int components = 1;
  std::vector<float> values;
};

/// A structured grid (.vts): points along x first, then y, then z. Nine digits: floats read back bit by bit.
std::string format_vts(const glm::ivec3& size, std::span<const glm::vec3> points, std::span<const NamedArray> arrays);
/// An image or volume (.vti) of evenly spaced points; `axes`: unit directions of x, y, z, by columns.
std::string format_vti(const glm::ivec3& size, const glm::dvec3& origin, const glm::dvec3& spacing,
                       std::span<const NamedArray> arrays, const glm::dmat3& axes = glm::dmat3(1));
/// Polylines (.vtp); `offsets`: the first point of each, and one past the last.
std::string format_lines(std::span<const std::uint32_t> offsets, std::span<const glm::vec3> points,
                         std::span<const NamedArray> arrays);

/// Triangles (.vtp), three indices each, with their normals.
std::string format_triangles(std::span<const glm::vec3> points, std::span<const glm::vec3> normals,
                             std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace cuticle::viz
