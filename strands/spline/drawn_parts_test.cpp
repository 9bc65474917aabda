// Parts of the drawn strands: how many a binding takes.
#include "strands/spline/drawn_parts.h"

#include <gtest/gtest.h>

namespace cuticle::strands::drawn_parts_test {

TEST(DrawnParts, VerticesThatOneBindingHolds_AreOnePart) {
  EXPECT_EQ(parts_of_strands(1 << 20, 2048, 32, k_vertex_bytes), 1u) << "2048 x 32 x 16 bytes fill it";
  EXPECT_EQ(parts_of_strands(1 << 20, 2049, 32, k_vertex_bytes), 2u);
  EXPECT_EQ(parts_of_strands(1 << 20, 2049, 32, k_color_bytes), 1u);
  EXPECT_EQ(parts_of_strands(1 << 20, 0, 32, k_vertex_bytes), 1u);
}

TEST(DrawnParts, OfAnySize_FitTheBindingAndBeginWhereOneMay) {
  for (std::uint32_t vertices : {2u, 3u, 16u, 17u, 255u, 1024u})
    for (std::uint32_t bytes : {k_color_bytes, k_vertex_bytes}) {
      constexpr std::uint64_t k_binding = 1 << 20;
      const std::uint64_t part = std::uint64_t(strands_of_a_part(k_binding, vertices, bytes)) * vertices * bytes;
      EXPECT_EQ(part % 256, 0u) << vertices << " " << bytes;
      EXPECT_LE(part, k_binding) << vertices << " " << bytes;
      EXPECT_GT(part + 32ull * vertices * bytes, k_binding) << "no room for a further step";
    }
}

}  // namespace cuticle::strands::drawn_parts_test
