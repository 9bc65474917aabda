#pragma once
// The grid on which strands meet: its nodes, what a vertex counts there, and the sums on the CPU.
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "strands/groom.h"

namespace cuticle::sim::strand_interaction {

/// Nodes in the head's space, around all that the strands could reach.
struct StrandGrid {
  std::array<std::uint32_t, 3> nodes{};  ///< along x, y, z
  glm::vec3 origin{0};                   ///< of the first, metres
  double cell = 1;                       ///< metres
  /// Half of a vertex's adjacent segments, as a whole number: at most 65,535, of a groom together less than 2^27; 0
  /// where a strand has no length.
  std::vector<std::uint32_t> masses;

  std::size_t node_count() const { return std::size_t(nodes[0]) * nodes[1] * nodes[2]; }
};
/// cell: metres. Error: bad_input where the grid would have more than 2^22 nodes, or the groom 2^26 vertices.
Result<StrandGrid> make_strand_grid(const strands::Groom& rest, double cell);

/// Mass times parts of 32^3, and that times the velocity in 2^-14 m/s.
struct NodeSums {
  std::array<std::int64_t, 3> momentum{};
  std::int64_t mass = 0;
};

/// The same as numbers: mean velocity in 2^-14 m/s.
struct NodeMean {
  glm::vec3 velocity{0};
  float mass = 0;
};

/// A vertex's lowest node and its place past it in 1/32 of a cell.
struct Spot {
  static constexpr std::uint32_t k_nowhere = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t node = k_nowhere, layer = 0;
  std::array<std::uint8_t, 3> fine{};
  bool is_fast = false, is_outside = false;
};

/// The sums of one moment. Whole numbers: the same at any number of threads.
class GridSums {
 public:
  explicit GridSums(const StrandGrid& grid);
  /// One place (in the head's space, metres) and velocity (m/s) for each mass. What an earlier moment left is cleared.
  void deposit(std::span<const glm::vec3> places, std::span<const glm::vec3> velocities);
  const Spot& spot(std::size_t vertex) const { return spots_[vertex]; }
  /// Node k of the eight about a vertex.
  const NodeMean& at(const Spot& spot, std::uint32_t k) const { return means_[spot.node + steps_[k]]; }
  std::span<const NodeSums> nodes() const { return sums_; }
  /// Vertices of the last moment that were outside the grid, and those counted at 128 m/s because they were faster.
  std::uint32_t left_out() const { return left_out_; }

 private:
  void find(std::size_t vertex, const glm::vec3& place, const glm::vec3& velocity);
  void sort_by_slab();
  void add(std::size_t vertex, const glm::vec3& velocity);
  template <class Work>
  void for_each_slab(const Work& work) const;
  template <class Work>
  void for_each_touched_row(const Work& work);
  void clear();
  void average();

  StrandGrid grid_;
  std::array<std::uint32_t, 8> steps_{};
  std::vector<NodeSums> sums_;
  std::vector<NodeMean> means_;
  std::vector<std::uint8_t> touched_;  ///< by row along x: whether any sum in it may be more than zero
  std::vector<Spot> spots_;
  std::vector<std::uint32_t> order_, slab_begins_;
  std::uint32_t left_out_ = 0;
};

}  // namespace cuticle::sim::strand_interaction
