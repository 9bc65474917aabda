#include "strands/cards/k_means.h"

#include <algorithm>
#include <limits>

#include "core/expect.h"
#include "core/random.h"

namespace cuticle::strands {

namespace {

/// Rows of numbers, one for each point.
struct Points {
  std::span<const float> values;
  std::size_t dimensions;
  std::size_t size() const { return values.size() / dimensions; }
  const float* operator[](std::size_t point) const { return values.data() + point * dimensions; }
};

float squared_distance(const float* a, const float* b, std::size_t dimensions) {
  float sum = 0;
  for (std::size_t k = 0; k < dimensions; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

std::uint32_t nearest_centre(const float* point, const Points& centres) {
  float least = std::numeric_limits<float>::max();
  std::uint32_t nearest = 0;
  for (std::size_t c = 0; c < centres.size(); ++c) {
    const float distance = squared_distance(point, centres[c], centres.dimensions);
    if (distance >= least) continue;
    least = distance;
    nearest = std::uint32_t(c);
  }
  return nearest;
}

/// At most k_max_trained of the points, evenly taken.
std::vector<float> trained_points(const Points& all) {
  const std::size_t count = std::min(all.size(), k_max_trained);
  std::vector<float> taken;
  taken.reserve(count * all.dimensions);
  for (std::size_t k = 0; k < count; ++k) {
    const float* point = all[k * all.size() / count];
    taken.insert(taken.end(), point, point + all.dimensions);
  }
  return taken;
}

/// A point drawn in proportion to its distance squared from the centres so far.
std::size_t drawn_point(std::span<const float> distances, RandomStream& random) {
  double sum = 0;
  for (float distance : distances) sum += double(distance);
  double left = random.next_unit() * sum;
  for (std::size_t p = 0; p < distances.size(); ++p) {
    left -= double(distances[p]);
    if (left < 0) return p;
  }
  return std::size_t(random.next_unit() * double(distances.size()));  // all points lie on centres
}

std::vector<float> seeded_centres(const Points& points, std::size_t count, RandomStream& random) {
  std::vector<float> centres, distances(points.size(), std::numeric_limits<float>::max());
  std::size_t next = std::size_t(random.next_unit() * double(points.size()));
  for (std::size_t c = 0; c < count; ++c) {
    centres.insert(centres.end(), points[next], points[next] + points.dimensions);
    for (std::size_t p = 0; p < points.size(); ++p)
      distances[p] = std::min(distances[p], squared_distance(points[p], points[next], points.dimensions));
    next = drawn_point(distances, random);
  }
  return centres;
}

/// Each centre moves to the mean of its points; one without points stays.
void move_centres(const Points& points, std::span<const std::uint32_t> of, std::vector<float>& centres) {
  const std::size_t size = points.dimensions;
  std::vector<double> sums(centres.size());
  std::vector<std::size_t> members(centres.size() / size);
  for (std::size_t p = 0; p < points.size(); ++p) {
    ++members[of[p]];
    for (std::size_t k = 0; k < size; ++k) sums[of[p] * size + k] += double(points[p][k]);
  }
  for (std::size_t k = 0; k < centres.size(); ++k)
    if (members[k / size] > 0) centres[k] = float(sums[k] / double(members[k / size]));
}

std::vector<std::uint32_t> assigned(const Points& points, const Points& centres) {
  std::vector<std::uint32_t> of(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) of[p] = nearest_centre(points[p], centres);
  return of;
}

/// Numbers the clusters anew, without those that hold no point.
Clusters compacted(std::vector<std::uint32_t> of, const std::vector<float>& centres, std::size_t dimensions) {
  constexpr std::uint32_t k_empty = 0xFFFFFFFF;
  std::vector<std::uint32_t> number(centres.size() / dimensions, k_empty);
  for (std::uint32_t c : of) number[c] = 0;
  Clusters clusters{.of = std::move(of), .centres = {}};
  for (std::size_t c = 0; c < number.size(); ++c) {
    if (number[c] == k_empty) continue;
    number[c] = std::uint32_t(clusters.count++);
    const auto first = centres.begin() + std::ptrdiff_t(c * dimensions);
    clusters.centres.insert(clusters.centres.end(), first, first + std::ptrdiff_t(dimensions));
  }
  for (std::uint32_t& c : clusters.of) c = number[c];
  return clusters;
}

}  // namespace

Clusters k_means(std::span<const float> values, std::size_t dimensions, std::size_t count, int iterations,
                 std::uint64_t seed) {
  const Points all{values, dimensions};
  CUTICLE_EXPECT(count > 0 && all.size() > 0, "clusters are made of points");
  const std::vector<float> taken = trained_points(all);
  const Points trained{taken, dimensions};
  RandomStream random(seed);
  std::vector<float> centres = seeded_centres(trained, std::min(count, trained.size()), random);
  for (int k = 0; k < iterations; ++k) move_centres(trained, assigned(trained, {centres, dimensions}), centres);
  return compacted(assigned(all, {centres, dimensions}), centres, dimensions);
}

}  // namespace cuticle::strands
