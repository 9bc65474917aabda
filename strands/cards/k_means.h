#pragma once
// Points put into groups of near ones.
#include <cstdint>
#include <span>
#include <vector>

namespace cuticle::strands {

struct Clusters {
  std::vector<std::uint32_t> of;  ///< per point its cluster
  std::vector<float> centres;     ///< per cluster its middle, `dimensions` numbers each
  std::size_t count = 0;          ///< of clusters, none without points
};
/// Lloyd's k-means from the seeds of k-means++ (Arthur and Vassilvitskii 2007), on at most `k_max_trained` points that
/// are evenly taken; then every point goes to the nearest centre, and clusters without points are left out. `values`:
/// `dimensions` finite numbers for each point. The same seed gives the same clusters. At least 1 and at most as many as
/// points.
Clusters k_means(std::span<const float> values, std::size_t dimensions, std::size_t count, int iterations,
                 std::uint64_t seed);
inline constexpr std::size_t k_max_trained = 8192;

}  // namespace cuticle::strands
