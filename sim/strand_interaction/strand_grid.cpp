#include "sim/strand_interaction/strand_grid.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/strand_interaction/strand_grid.glslh"

namespace cuticle::sim::strand_interaction {
namespace {

constexpr double k_max_nodes = 1 << 22;
constexpr std::size_t k_max_vertices = std::size_t(1) << 26;
constexpr double k_max_mass = (1 << 27) - 1;
constexpr std::uint32_t k_slab = 2;  // layers of cells in a slab, so that its nodes touch the next slab's only

std::vector<double> lengths_of_vertices(const strands::Groom& rest) {
  std::vector<double> lengths(rest.vertex_count(), 0.0);
  for (std::size_t s = 0; s < rest.strand_count(); ++s)
    for (std::size_t i = rest.offsets[s] + 1; i < rest.offsets[s + 1]; ++i) {
      const double half = 0.5 * glm::distance(glm::dvec3(rest.positions[i - 1]), glm::dvec3(rest.positions[i]));
      lengths[i - 1] += half;
      lengths[i] += half;
    }
  return lengths;
}

std::vector<std::uint32_t> whole_masses(const strands::Groom& rest) {
  const std::vector<double> lengths = lengths_of_vertices(rest);
  double total = 0, longest = 0;
  for (double length : lengths) {
    total += length;
    longest = std::max(longest, length);
  }
  const double unit = std::max(total / (k_max_mass - double(lengths.size())), longest / 65535);
  std::vector<std::uint32_t> masses;
  for (double length : lengths)
    masses.push_back(length > 0 ? std::uint32_t(std::clamp(std::floor(length / unit + 0.5), 1.0, 65535.0)) : 0);
  return masses;
}

/// All places that are no farther from a strand's root than it is long.
strands::Bounds reach_of(const strands::Groom& rest) {
  strands::Bounds reach = strands::bounds(rest);
  for (std::size_t s = 0; s < rest.strand_count(); ++s) {
    if (rest.strand_size(s) == 0) continue;
    const glm::vec3 root = rest.strand(s)[0], length(float(strands::strand_length(rest, s)));
    reach = {glm::min(reach.lower, root - length), glm::max(reach.upper, root + length)};
  }
  return reach;
}

}  // namespace

Result<StrandGrid> make_strand_grid(const strands::Groom& rest, double cell) {
  if (rest.vertex_count() > k_max_vertices)
    return bad_input(fmt::format("strand_interaction: {} vertices; at most {}", rest.vertex_count(), k_max_vertices));
  const strands::Bounds reach = reach_of(rest);
  const glm::dvec3 cells = glm::ceil((glm::dvec3(reach.upper) - glm::dvec3(reach.lower)) / cell) + 2.0;
  const double count = (cells.x + 1) * (cells.y + 1) * (cells.z + 1);
  if (!(count <= k_max_nodes))
    return bad_input(
        fmt::format("strand_interaction: cell: {} m makes {:.3g} nodes; at most {:.0f}: choose at least "
                    "{:.3g} m",
                    cell, count, k_max_nodes, cell * std::cbrt(count / k_max_nodes)));
  StrandGrid grid{.origin = glm::vec3(glm::dvec3(reach.lower) - cell), .cell = cell, .masses = whole_masses(rest)};
  for (int c = 0; c < 3; ++c) grid.nodes[std::size_t(c)] = std::uint32_t(cells[c]) + 1;
  return grid;
}

GridSums::GridSums(const StrandGrid& grid)
    : grid_(grid),
      sums_(grid.node_count()),
      means_(grid.node_count()),
      touched_(std::size_t(grid.nodes[1]) * grid.nodes[2], 0),
      spots_(grid.masses.size()) {
  for (std::uint32_t k = 0; k < 8; ++k)
    steps_[k] = (k & 1) + ((k >> 2 & 1) + (k >> 1 & 1) * grid.nodes[2]) * grid.nodes[0];
}

void GridSums::find(std::size_t vertex, const glm::vec3& place, const glm::vec3& velocity) {
  Spot& spot = spots_[vertex] = {};
  if (grid_.masses[vertex] == 0) return;
  GridFrame<float> frame{};
  frame.origin = grid_.origin;
  frame.per_fine = float(32 / grid_.cell);
  const glm::vec3 fine = fine_place(frame, place);
  std::array<std::uint32_t, 3> cell{};
  for (std::size_t c = 0; c < 3; ++c) {
    const float along = fine[int(c)];
    spot.is_outside |= !(along >= 0 && along < float((grid_.nodes[c] - 1) * 32));
    if (spot.is_outside) return;
    cell[c] = std::uint32_t(along) / 32;
    spot.fine[c] = std::uint8_t(std::uint32_t(along) % 32);
    spot.is_fast |= std::abs(velocity[int(c)]) > 128;
  }
  spot.node = (cell[1] * grid_.nodes[2] + cell[2]) * grid_.nodes[0] + cell[0];
  spot.layer = cell[1];
}

void GridSums::sort_by_slab() {
  slab_begins_.assign(grid_.nodes[1] / k_slab + 2, 0);
  left_out_ = 0;
  for (const Spot& spot : spots_) {
    left_out_ += spot.is_outside || spot.is_fast;
    if (spot.node != Spot::k_nowhere) ++slab_begins_[spot.layer / k_slab + 1];
  }
  for (std::size_t k = 1; k < slab_begins_.size(); ++k) slab_begins_[k] += slab_begins_[k - 1];
  order_.resize(slab_begins_.back());
  std::vector<std::uint32_t> next(slab_begins_.begin(), slab_begins_.end() - 1);
  for (std::uint32_t i = 0; i < spots_.size(); ++i)
    if (spots_[i].node != Spot::k_nowhere) order_[next[spots_[i].layer / k_slab]++] = i;
}

/// Slabs that share no node at once: the even ones, then the odd ones.
template <class Work>
void GridSums::for_each_slab(const Work& work) const {
  const std::size_t slabs = slab_begins_.empty() ? 0 : slab_begins_.size() - 1;
  for (std::size_t first : {0, 1})
    tbb::parallel_for(first, slabs, std::size_t(2), [&](std::size_t slab) {
      for (std::size_t k = slab_begins_[slab]; k < slab_begins_[slab + 1]; ++k) work(order_[k]);
    });
}

void GridSums::add(std::size_t vertex, const glm::vec3& velocity) {
  const Spot& spot = spots_[vertex];
  const std::size_t row = spot.node / grid_.nodes[0];
  for (std::size_t k : {row, row + 1, row + grid_.nodes[2], row + grid_.nodes[2] + 1}) touched_[k] = 1;
  std::array<std::int64_t, 3> speed{};
  for (std::size_t c = 0; c < 3; ++c) speed[c] = std::int64_t(counted_speed(velocity[int(c)]));
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < 8; ++k) {
    const std::int64_t mass =
        std::int64_t(node_weight(k, spot.fine[0], spot.fine[1], spot.fine[2])) * grid_.masses[vertex];
    NodeSums& sums = sums_[spot.node + steps_[k]];
    for (std::size_t c = 0; c < 3; ++c) sums.momentum[c] += mass * speed[c];
    sums.mass += mass;
  }
}

template <class Work>
void GridSums::for_each_touched_row(const Work& work) {
  tbb::parallel_for(std::size_t(0), touched_.size(), [&](std::size_t row) {
    if (!touched_[row]) return;
    for (std::size_t k = row * grid_.nodes[0]; k < (row + 1) * grid_.nodes[0]; ++k) work(sums_[k], means_[k]);
  });
}

void GridSums::clear() {
  for_each_touched_row([](NodeSums& sums, NodeMean&) { sums = {}; });
  std::fill(touched_.begin(), touched_.end(), 0);
}

void GridSums::average() {
  for_each_touched_row([](const NodeSums& sums, NodeMean& mean) {
    mean = {};
    if (sums.mass == 0) return;
    mean.mass = float(sums.mass);
    mean.velocity = glm::vec3(sums.momentum[0], sums.momentum[1], sums.momentum[2]) * (1 / mean.mass);
  });
}

void GridSums::deposit(std::span<const glm::vec3> places, std::span<const glm::vec3> velocities) {
  clear();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, spots_.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) find(i, places[i], velocities[i]);
  });
  sort_by_slab();
  for_each_slab([&](std::size_t i) { add(i, velocities[i]); });
  average();
}

}  // namespace cuticle::sim::strand_interaction
