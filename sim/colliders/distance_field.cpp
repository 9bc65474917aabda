#include "sim/colliders/distance_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "sim/colliders/field_sample.glslh"
#include "strands/binding/nearest_triangle.h"

namespace cuticle::sim {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr int k_margin = 2;  // cells beyond the mesh

/// Places of the nodes of a grid.
struct Grid {
  glm::dvec3 lower{0};
  double spacing = 1;
  glm::ivec3 nodes{0};
  glm::dvec3 at(int x, int y, int z) const { return lower + spacing * glm::dvec3(x, y, z); }
  std::size_t index(int x, int y, int z) const {
    return std::size_t(x) + std::size_t(nodes.x) * (std::size_t(y) + std::size_t(nodes.y) * std::size_t(z));
  }
  std::size_t count() const { return std::size_t(nodes.x) * std::size_t(nodes.y) * std::size_t(nodes.z); }
};

Result<void> check_mesh(const strands::Mesh& mesh, const std::string& where) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(mesh.positions[i][c]))
        return bad_input(fmt::format("{}: vertex {}: component {} is not finite", where, i, c));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t corner : mesh.triangles[t])
      if (corner >= mesh.positions.size())
        return bad_input(fmt::format("{}: triangle {}: vertex {}, allowed 0 .. {}", where, t, corner,
                                     std::int64_t(mesh.positions.size()) - 1));
  return {};
}

/// Of each vertex the first that stands at its place.
std::vector<std::uint32_t> first_at_place(const strands::Mesh& mesh) {
  const auto key = [&](std::uint32_t v) {
    const glm::vec3& p = mesh.positions[v];
    return std::tuple(p.x, p.y, p.z, v);
  };
  std::vector<std::uint32_t> order(mesh.positions.size()), first(order.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, key);
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] =
        k > 0 && mesh.positions[order[k]] == mesh.positions[order[k - 1]] ? first[order[k - 1]] : order[k];
  return first;
}

/// An edge between two places, and the triangles that run along it less those that run against it.
struct DirectedEdge {
  std::uint32_t from = 0, to = 0;
  int balance = 0;
};

/// Edges where the triangles of both ways are not equally many.
std::vector<DirectedEdge> open_edges(const strands::Mesh& mesh) {
  const std::vector<std::uint32_t> first = first_at_place(mesh);
  std::vector<DirectedEdge> edges;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = first[t[k]], b = first[t[(k + 1) % 3]];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  std::ranges::sort(edges, {}, [](const DirectedEdge& e) { return std::tuple(e.from, e.to); });
  std::vector<DirectedEdge> open;
  for (const DirectedEdge& edge : edges) {
    if (!open.empty() && open.back().from == edge.from && open.back().to == edge.to)
      open.back().balance += edge.balance;
    else
      open.push_back(edge);
  }
  std::erase_if(open, [](const DirectedEdge& e) { return e.balance == 0; });
  return open;
}

Result<void> check_closed(const strands::Mesh& mesh, const std::string& where) {
  const std::vector<DirectedEdge> open = open_edges(mesh);
  if (open.empty()) return {};
  const glm::vec3 &a = mesh.positions[open[0].from], &b = mesh.positions[open[0].to];
  return bad_input(fmt::format("{}: {} open edges, allowed 0: the first from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, "
                               "{:.4g}, {:.4g}) m",
                               where, open.size(), a.x, a.y, a.z, b.x, b.y, b.z),
                   "close the mesh: only a closed surface has an inside");
}

Result<Grid> grid_around(const strands::Mesh& mesh, double spacing, const std::string& where) {
  if (!(spacing > 0 && spacing <= k_largest_spacing))
    return bad_input(fmt::format("{}: spacing {} m, allowed above 0 .. {}", where, spacing, k_largest_spacing));
  glm::dvec3 lower(mesh.positions[mesh.triangles[0][0]]), upper = lower;
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t corner : t) {
      lower = glm::min(lower, glm::dvec3(mesh.positions[corner]));
      upper = glm::max(upper, glm::dvec3(mesh.positions[corner]));
    }
  const glm::dvec3 cells = glm::ceil((upper - lower) / spacing) + 2.0 * k_margin, nodes = cells + 1.0;
  if (!(nodes.x * nodes.y * nodes.z <= double(k_max_field_nodes)))
    return bad_input(fmt::format("{}: spacing {} m makes {:.0f} x {:.0f} x {:.0f} nodes, allowed {} in all", where,
                                 spacing, nodes.x, nodes.y, nodes.z, k_max_field_nodes),
                     "choose a wider spacing");
  return Grid{(lower + upper - cells * spacing) / 2.0, spacing, glm::ivec3(nodes)};
}

/// Twice the area of a, b, p; the same but for its sign with a and b exchanged, to the last digit.
double area_beside(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  if (std::tuple(b.x, b.y) < std::tuple(a.x, a.y)) return -area_beside(b, a, p);
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Whether p lies left of an edge. One on the edge does for one of the edge's two ways.
bool is_left_of(const glm::dvec2& a, const glm::dvec2& b, double area) {
  return area > 0 || (area == 0 && (b.y > a.y || (b.y == a.y && b.x > a.x)));
}

/// Where a line along x meets the surface, and by how much the winding grows there for one who walks along x.
struct Crossing {
  double x = 0;
  int turn = 0;
};

/// The lines along x through a grid's nodes, and how often the surface winds around each node.
class Lines {
 public:
  Lines(const strands::Mesh& mesh, const Grid& grid)
      : grid_(grid), crossings_(std::size_t(grid.nodes.y) * std::size_t(grid.nodes.z)) {
    for (const Triangle& t : mesh.triangles)
      add({glm::dvec3(mesh.positions[t[0]]), glm::dvec3(mesh.positions[t[1]]), glm::dvec3(mesh.positions[t[2]])});
    for (std::vector<Crossing>& line : crossings_) std::ranges::sort(line, {}, &Crossing::x);
  }

  /// Which nodes of a line are inside.
  std::vector<bool> inside(int y, int z) const {
    const std::vector<Crossing>& line = crossings_[line_at(y, z)];
    std::vector<bool> result(std::size_t(grid_.nodes.x), false);
    std::size_t passed = 0;
    int winding = 0;
    for (int x = 0; x < grid_.nodes.x; ++x) {
      for (; passed < line.size() && line[passed].x <= grid_.at(x, 0, 0).x; ++passed) winding += line[passed].turn;
      result[std::size_t(x)] = winding != 0;
    }
    return result;
  }

 private:
  using Corners = std::array<glm::dvec3, 3>;
  std::size_t line_at(int y, int z) const { return std::size_t(y) + std::size_t(grid_.nodes.y) * std::size_t(z); }

  void add(Corners corners) {
    const auto flat = [](const glm::dvec3& p) { return glm::dvec2(p.y, p.z); };
    const double area = area_beside(flat(corners[0]), flat(corners[1]), flat(corners[2]));
    if (area == 0) return;
    if (area < 0) std::swap(corners[1], corners[2]);
    const glm::dvec2 a = flat(corners[0]), b = flat(corners[1]), c = flat(corners[2]);
    const glm::dvec2 origin = flat(grid_.lower);
    const glm::ivec2 most(grid_.nodes.y - 1, grid_.nodes.z - 1);
    const glm::ivec2 from(glm::ceil((glm::min(a, glm::min(b, c)) - origin) / grid_.spacing)),
        to(glm::floor((glm::max(a, glm::max(b, c)) - origin) / grid_.spacing));
    for (int z = std::max(from.y, 0); z <= std::min(to.y, most.y); ++z)
      for (int y = std::max(from.x, 0); y <= std::min(to.x, most.x); ++y) meet(corners, y, z, area > 0 ? -1 : 1);
  }

  /// corners: counterclockwise seen along x.
  void meet(const Corners& corners, int y, int z, int turn) {
    const glm::dvec3 node = grid_.at(0, y, z);
    const glm::dvec2 p(node.y, node.z);
    double areas[3], sum = 0, x = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 &from = corners[(k + 1) % 3], &to = corners[(k + 2) % 3];
      areas[k] = area_beside({from.y, from.z}, {to.y, to.z}, p);
      if (!is_left_of({from.y, from.z}, {to.y, to.z}, areas[k])) return;
      sum += areas[k];
    }
    for (std::size_t k = 0; k < 3; ++k) x += corners[k].x * (areas[k] / sum);
    crossings_[line_at(y, z)].push_back({x, turn});
  }

  Grid grid_;
  std::vector<std::vector<Crossing>> crossings_;
};

std::vector<float> signed_distances(const strands::Mesh& mesh, const strands::NearestTriangle& nearest,
                                    const Grid& grid) {
  const Lines lines(mesh, grid);
  std::vector<float> values(grid.count());
  tbb::parallel_for(0, grid.nodes.z, [&](int z) {
    for (int y = 0; y < grid.nodes.y; ++y) {
      const std::vector<bool> inside = lines.inside(y, z);
      for (int x = 0; x < grid.nodes.x; ++x) {
        const double distance = nearest.at(grid.at(x, y, z)).distance;
        values[grid.index(x, y, z)] = float(inside[std::size_t(x)] ? -distance : distance);
      }
    }
  });
  return values;
}

/// Whether the surface passes between the corners of a cell.
bool is_crossed(const Grid& grid, const std::vector<float>& values, int x, int y, int z) {
  const bool inside = values[grid.index(x, y, z)] < 0;
  for (int k = 1; k < 8; ++k)
    if ((values[grid.index(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2))] < 0) != inside) return true;
  return false;
}

double error_at_middles(const strands::Mesh& mesh, const strands::NearestTriangle& nearest, const Grid& grid,
                        const std::vector<float>& values) {
  const Grid middles{grid.lower + grid.spacing / 2, grid.spacing, grid.nodes - 1};
  const Lines lines(mesh, middles);
  std::vector<double> errors(std::size_t(middles.nodes.z), 0);
  tbb::parallel_for(0, middles.nodes.z, [&](int z) {
    for (int y = 0; y < middles.nodes.y; ++y) {
      const std::vector<bool> inside = lines.inside(y, z);
      for (int x = 0; x < middles.nodes.x; ++x) {
        if (!is_crossed(grid, values, x, y, z)) continue;
        const double distance = nearest.at(middles.at(x, y, z)).distance;
        const double here = trilinear(values.data(), glm::dvec3(x, y, z) + 0.5, glm::dvec3(middles.nodes)).distance;
        double& most = errors[std::size_t(z)];
        most = std::max(most, std::abs(here - (inside[std::size_t(x)] ? -distance : distance)));
      }
    }
  });
  return *std::ranges::max_element(errors);
}

}  // namespace

Result<DistanceField> bake_distance_field(const strands::Mesh& mesh, double spacing, const std::string& where) {
  CUTICLE_TRY(check_mesh(mesh, where));
  const strands::NearestTriangle nearest(mesh);
  if (nearest.empty()) return bad_input(fmt::format("{}: no triangle with area, at least 1 is needed", where));
  CUTICLE_TRY(check_closed(mesh, where));
  CUTICLE_ASSIGN(const Grid grid, grid_around(mesh, spacing, where));
  DistanceField field;
  field.spacing = spacing;
  field.cells = grid.nodes - 1;
  field.centre = grid.lower + glm::dvec3(field.cells) * (spacing / 2);
  field.values = signed_distances(mesh, nearest, grid);
  if (std::ranges::none_of(field.values, [](float value) { return value < 0; }))
    return bad_input(fmt::format("{}: spacing {} m: no node of the grid lies inside the mesh", where, spacing),
                     "choose a finer spacing; a mesh without thickness has no inside");
  field.error = error_at_middles(mesh, nearest, grid, field.values);
  return field;
}

}  // namespace cuticle::sim
