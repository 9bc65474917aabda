// Settings swept over shadow methods: each takes those that it knows.
#include <gtest/gtest.h>

#include "study/shadows/comparison.h"

namespace cuticle::study::candidates_test {
namespace {

TEST(Candidates, SweptMethods_TakeWhatTheyKnow) {
  const std::string methods[] = {"none", "opacity_map"};
  const auto candidates = candidates_of(methods, {{4, 8}, {64, 128, 256}, {0.001}, {}});
  ASSERT_TRUE(candidates);
  ASSERT_EQ(candidates->size(), 7u);
  EXPECT_EQ(settings_text((*candidates)[0]), "");
  EXPECT_EQ(settings_text((*candidates)[1]), "filter_radius_mm=1,resolution=64,slices=4");
  EXPECT_FALSE(candidates_of(methods, {{1}, {}, {}, {}}));
  const auto skipped = candidates_of(methods, {{1}, {}, {}, {}, true});
  ASSERT_TRUE(skipped);
  EXPECT_EQ(skipped->size(), 1u);
  const auto fewer = candidates_of(methods, {{1, 4}, {}, {}, {}});
  ASSERT_TRUE(fewer);
  EXPECT_EQ(fewer->size(), 2u) << "one is no number of slices";
  const std::string spaced[] = {"opacity_map", "deep_opacity", "voxel"};
  const auto spacings = candidates_of(spaced, {{4}, {}, {}, {"geometric", "equal", "printed"}});
  ASSERT_TRUE(spacings);
  EXPECT_EQ(spacings->size(), 5u) << "one, two, and the two cases of a method without layers";
  const std::string bounded[] = {"deep_shadow"};
  const auto bounds = candidates_of(bounded, {{1, 4, 16, 64}, {64}, {}, {}});
  ASSERT_TRUE(bounds);
  EXPECT_EQ(bounds->size(), 2u) << "the two cases of a method that needs as many pieces as its bound asks for";
  EXPECT_EQ(left_out_of(spaced, {{4, 16, 64}, {}, {}, {}}),
            std::vector<std::string>{"deep_opacity: layers 64 left out, it takes 1 .. 16"});
  EXPECT_TRUE(left_out_of(spaced, {{4, 8}, {}, {}, {}}).empty());
  const std::string filtered[] = {"shadow_map"};
  const auto same = candidates_of(filtered, {{4}, {64, 128}, {}, {}, false, {1}});
  ASSERT_TRUE(same);
  EXPECT_EQ(same->size(), 4u) << "two of the three cases differ by the filter alone";
  const std::string unknown[] = {"opacity"};
  EXPECT_FALSE(candidates_of(unknown, {}));
}

}  // namespace
}  // namespace cuticle::study::candidates_test
