#include <cuticle/shadows/clouds.h>

#include <cuticle/core/result.h>

namespace cuticle::shadows {

strands::Groom point_casters(std::span<const glm::vec3> points, std::span<const float> radii) {
  std::vector<glm::vec3> ends;
  for (const glm::vec3& point : points) ends.insert(ends.end(), {point, point});
  return segment_casters(ends, radii);
}

strands::Groom segment_casters(std::span<const glm::vec3> ends, std::span<const float> radii) {
  const std::size_t count = ends.size() / 2;
  CUTICLE_EXPECT(ends.size() % 2 == 0, "a segment has two ends");
  CUTICLE_EXPECT(radii.size() == 1 || radii.size() == count, "one radius for all or one for each");
  strands::Groom groom;
  groom.positions.assign(ends.begin(), ends.end());
  for (std::size_t i = 0; i < count; ++i) {
    groom.offsets.push_back(std::uint32_t(2 * (i + 1)));
    groom.radii.insert(groom.radii.end(), 2, radii[radii.size() == 1 ? 0 : i]);
  }
  return groom;
}

}  // namespace cuticle::shadows
