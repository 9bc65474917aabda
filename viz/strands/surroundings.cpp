#include "viz/strands/surroundings.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "sim/strand_interaction/strand_grid.h"

namespace cuticle::viz {
namespace {

RoundedBox box_of(const Sphere& sphere) { return {.center = sphere.center, .radius = sphere.radius}; }
RoundedBox box_of(const RoundedBox& box) { return box; }
RoundedBox box_of(const sim::FieldPointer&) { return {}; }

/// Of a cube's face: its outward axis and those along it, of a right-handed three.
struct Face {
  glm::dvec3 out, right, up;
};

/// A node of the cube, moved to where its direction meets the rounding about its corner. With an odd number of parts
/// none lies in a middle plane, so that the two halves part there and leave flat faces between them. A sharp box keeps
/// its faces' normals.
void add_node(strands::Mesh& mesh, const RoundedBox& box, const Face& face, double x, double y) {
  const glm::dvec3 direction = glm::normalize(face.out + x * face.right + y * face.up);
  const glm::dvec3 corner = glm::sign(face.out + x * face.right + y * face.up) * box.half_size;
  mesh.positions.emplace_back(box.center + box.axes * (corner + box.radius * direction));
  mesh.normals.emplace_back(box.axes * (box.radius > 0 ? direction : face.out));
}

/// Places of nodes along an edge, -1 .. 1, none at 0.
double node_at(int k, int parts) { return std::tan((2.0 * k / parts - 1) * 0.785398163397448); }

void add_face(strands::Mesh& mesh, const RoundedBox& box, const Face& face, int parts) {
  const auto first = std::uint32_t(mesh.positions.size()), row = std::uint32_t(parts) + 1;
  for (int j = 0; j <= parts; ++j)
    for (int i = 0; i <= parts; ++i) add_node(mesh, box, face, node_at(i, parts), node_at(j, parts));
  for (std::uint32_t j = 0; j + 1 < row; ++j)
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = first + j * row + i, b = a + 1, c = b + row, d = a + row;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
}

/// x fastest, up to `end`.
template <class Visit>
void for_each_node(const glm::ivec3& begin, const glm::ivec3& end, const Visit& visit) {
  for (int z = begin.z; z < end.z; ++z)
    for (int y = begin.y; y < end.y; ++y)
      for (int x = begin.x; x < end.x; ++x) visit(glm::ivec3(x, y, z));
}

}  // namespace

strands::Mesh surface_of(const sim::PlacedCollider& collider, int parts) {
  strands::Mesh mesh;
  if (std::holds_alternative<sim::FieldPointer>(collider.shape)) return mesh;
  const RoundedBox box = std::visit([](const auto& shape) { return box_of(shape); }, collider.shape);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Face face{};
      face.out[axis] = side;
      face.right[(axis + 1) % 3] = side;
      face.up[(axis + 2) % 3] = 1;
      add_face(mesh, box, face, parts + 1 - parts % 2);
    }
  const glm::dmat4 placed =
      glm::translate(glm::dmat4(1), collider.place.position) * glm::mat4_cast(collider.place.rotation);
  return strands::transformed(mesh, placed);
}

Result<VolumeGrid> hair_density(const strands::Groom& groom, double cell) {
  CUTICLE_ASSIGN(const auto grid, sim::strand_interaction::make_strand_grid(groom, cell));
  sim::strand_interaction::GridSums sums(grid);
  sums.deposit(groom.positions, std::vector<glm::vec3>(groom.vertex_count(), glm::vec3(0)));
  // Rows along x lie by z, then by y.
  const auto mass_at = [&](const glm::ivec3& n) {
    return sums.nodes()[(std::size_t(n.y) * grid.nodes[2] + std::size_t(n.z)) * grid.nodes[0] + std::size_t(n.x)].mass;
  };
  const glm::ivec3 nodes(grid.nodes[0], grid.nodes[1], grid.nodes[2]);
  double total = 0, length = 0;
  glm::ivec3 lower = nodes - 1, upper(0);  // of the nodes that have hair
  for_each_node(glm::ivec3(0), nodes, [&](const glm::ivec3& n) {
    if (mass_at(n) == 0) return;
    total += double(mass_at(n));
    lower = glm::min(lower, n);
    upper = glm::max(upper, n);
  });
  lower = glm::max(glm::min(lower, upper) - 1, glm::ivec3(0));
  upper = glm::min(upper + 2, nodes);
  for (std::size_t s = 0; s < groom.strand_count(); ++s) length += strands::strand_length(groom, s);
  const double scale = total > 0 ? length / total / (cell * cell * cell) * 1e-6 : 0;  // 1/m^2 -> 1/mm^2
  VolumeGrid density{.size = upper - lower,
                     .origin = glm::dvec3(grid.origin) + cell * glm::dvec3(lower),
                     .spacing = cell,
                     .values = {}};
  for_each_node(lower, upper,
                [&](const glm::ivec3& n) { density.values.push_back(float(scale * double(mass_at(n)))); });
  return density;
}

}  // namespace cuticle::viz
