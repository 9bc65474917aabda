// The tile passes, from coloured strands to the picture, beside brute force on the CPU (truth/rasterise.h).
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include "core/random.h"
#include "strands/lod/lod.h"
#include "tests/support/tile_passes.h"

namespace cuticle::render::tiles_gpu_test {
namespace {

using tests::bundle, tests::draw, tests::Drawing, tests::Drawn, tests::mean_difference, tests::Tiles;

const glm::vec3 k_red(1, 0, 0), k_green(0, 1, 0);

TEST(Tiles, StrandAlongARow_HasTheAnalyticCoverage) {
  for (float width : {0.05f, 0.3f, 1.0f}) {
    Drawing drawing;
    drawing.coverage_rows = 0;
    drawing.strand({{-5, 0.5f * drawing.pixel(), 0}, {5, 0.5f * drawing.pixel(), 0}}, 0.5f * width * drawing.pixel(),
                   k_red);
    const Drawn drawn = draw(drawing);
    for (int x = 1; x < drawing.size - 1; ++x) ASSERT_NEAR(drawn.alpha(x, 31), width, 1e-3f) << x;
    EXPECT_NEAR(drawn.alpha(30, 33), 0, 1e-3);
  }
}

// Wherever it lies in the pixel, by rows of samples: 128 lie at as many distances from it.
TEST(Tiles, StrandAlongARowOrAColumn_CoversAsManySamplesAsItsWidth) {
  for (bool is_row : {false, true})
    for (float width : {0.05f, 0.3f, 0.8f})
      for (float from_middle : {0.0f, 0.03f, 0.09f}) {
        Drawing drawing;
        const float at = (0.5f + from_middle) * drawing.pixel(), half = 0.5f * width * drawing.pixel();
        if (is_row) drawing.strand({{-5, at, 0}, {5, at, 0}}, half, k_red);
        if (!is_row) drawing.strand({{at, -5, 0}, {at, 5, 0}}, half, k_red);
        const Drawn drawn = draw(drawing);
        for (int k = 1; k < drawing.size - 1; ++k)
          ASSERT_NEAR(is_row ? drawn.alpha(k, 31) : drawn.alpha(32, k), width, 1.0 / 128) << k << " " << from_middle;
      }
}

// Both of a pair that cover the same half of a pixel leave the other half open; side by side they close it.
TEST(Tiles, StrandsInOnePixel_CoverTheUnionOfTheirParts) {
  for (float apart : {0.0f, 0.5f}) {
    Drawing drawing;
    const float thin = 0.25f * drawing.pixel(), first = 0.25f * drawing.pixel();
    drawing.strand({{-5, first, 0}, {5, first, 0}}, thin, k_red);
    const float second = first + apart * drawing.pixel();
    drawing.strand({{-5, second, -1e-3f}, {5, second, -1e-3f}}, 1.02f * thin, k_green);
    const Drawn drawn = draw(drawing);
    EXPECT_NEAR(drawn.alpha(20, 31), apart > 0 ? 1 : 0.5, 0.01);
    EXPECT_NEAR(drawn.color.at(20, 31, 0), 0.5, 0.01) << "the nearer one is whole";
  }
}

// Bends of less than a pixel leave neither dots nor gaps: what covers is one strand.
TEST(Tiles, JointsOfAStrand_ChangeNothingOfItsCoverage) {
  const auto error_of = [](int vertices) {
    Drawing drawing;
    std::vector<glm::vec3> points;
    for (int k = 0; k < vertices; ++k) {
      const float s = float(k) / float(vertices - 1);
      points.emplace_back(-3.5f + 7 * s, -2.9f + 5.2f * s, 0);
    }
    drawing.strand(points, 0.35f * drawing.pixel(), k_red);
    return mean_difference(draw(drawing).color, drawing.truth(), 3, 4);
  };
  const double whole = error_of(2), of_many = error_of(300);
  std::printf("one segment: error %.5f, 299: %.5f\n", whole, of_many);
  EXPECT_LT(of_many, 1.2 * whole + 1e-4);
}

TEST(Tiles, CrossingStrands_TheNearerOneIsInFront) {
  for (double opacity : {1.0, 0.4})
    for (float z : {-0.5f, 0.5f}) {
      Drawing drawing;
      drawing.opacity = opacity;
      const float middle = 0.5f * drawing.pixel(), wide = 3 * drawing.pixel();
      drawing.strand({{-3, middle, 0}, {3, middle, 0}}, wide, k_red);
      drawing.strand({{middle, -3, z}, {middle, 3, z}}, wide, k_green);
      const Drawn drawn = draw(drawing);
      const Image truth = drawing.truth();
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(drawn.color.at(32, 31, c), truth.at(32, 31, c), 2e-3) << z << " " << c;
    }
}

// A strand far away makes the bins of depth so wide that the two in front of it share one.
TEST(Tiles, DepthsOfOneBin_AreStillInOrder) {
  for (bool nearer_first : {true, false}) {
    Drawing drawing;
    const auto across = [&](float z, const glm::vec3& color) { drawing.strand({{-3, 0, z}, {3, 0, z}}, 0.4f, color); };
    across(-30, {0, 0, 1});
    if (nearer_first) across(0, k_red);
    across(-0.01f, k_green);
    if (!nearer_first) across(0, k_red);
    EXPECT_NEAR(draw(drawing).color.at(32, 32, 0), 1, 2e-3) << nearer_first;
  }
}

struct BundleCase {
  double opacity;
  std::int64_t rows;
  double coverage, color;  // at most
};

TEST(Tiles, BundleOfStrands_IsNearTheTruth) {
  for (const BundleCase& of :
       {BundleCase{1, 0, 0.023, 0.026}, BundleCase{0.4, 8, 0.018, 0.012}, BundleCase{1, 2, 0.0065, 0.012},
        BundleCase{1, 4, 0.0035, 0.008}, BundleCase{1, 8, 0.0027, 0.0075}, BundleCase{1, 16, 0.0026, 0.0075}}) {
    Drawing drawing = bundle(300);
    drawing.opacity = of.opacity;
    drawing.coverage_rows = of.rows;
    const Drawn drawn = draw(drawing);
    const Image truth = drawing.truth();
    const double coverage = mean_difference(drawn.color, truth, 3, 4),
                 color = mean_difference(drawn.color, truth, 0, 3);
    std::printf("opacity %g, %d rows: coverage error %.5f, colour error %.5f\n", of.opacity, int(of.rows), coverage,
                color);
    EXPECT_LT(coverage, of.coverage);
    EXPECT_LT(color, of.color);
  }
}

// A lock combed straight, at an angle to rows and columns, of one width; the error must fall with the rows.
TEST(Tiles, StraightBundle_IsCoveredWithinAFewThousandths) {
  for (float width : {0.1f, 0.3f, 1.2f}) {
    Drawing drawing;
    for (int k = 0; k < int(90 / width); ++k) {
      const float x = -5.5f + 8 * std::fmod(float(k) * 0.618034f, 1.0f) + 0.7f * std::fmod(float(k) * 0.754878f, 1.0f);
      drawing.strand({{x, -4, -0.001f * float(k)}, {x + 3, 4, -0.001f * float(k)}}, 0.5f * width * drawing.pixel(),
                     k_red);
    }
    const Image truth = drawing.truth(48);
    double last = 1;
    for (std::int64_t rows : {0, 2, 4, 8, 16}) {
      drawing.coverage_rows = rows;
      const double error = mean_difference(draw(drawing).color, truth, 3, 4);
      std::printf("straight, %g px wide, %d rows: coverage error %.5f\n", double(width), int(rows), error);
      EXPECT_LT(error, rows <= 8 ? last : 1.15 * last) << width << " " << rows;
      if (rows >= 8) {
        EXPECT_LT(error, width > 0.2f ? 0.003 : 0.005) << width;
      }
      last = error;
    }
  }
}

// Rows of samples lie across most strands of a tile, not across those that happen to be in front.
TEST(Tiles, ThinStrandsBehindAFewAcrossThem_AreCoveredAsWell) {
  Drawing drawing;
  RandomStream random(3);
  const auto place = [&] { return 8 * float(random.next_unit()) - 4; };
  const float pixel = drawing.pixel();
  for (int k = 0; k < 600; ++k) {
    const float y = place();
    drawing.strand({{-4, y, 0.5f}, {4, y + 0.2f, 0.5f}}, 0.01f * pixel, k_red);
  }
  for (int k = 0; k < 4000; ++k) {
    const float x = place(), lean = 0.02f * place();
    drawing.strand({{x - lean, -4, -0.5f}, {x + lean, 4, -0.5f}}, 0.01f * pixel, k_green);
  }
  const double error = mean_difference(draw(drawing).color, drawing.truth(32), 3, 4);
  std::printf("behind strands across: coverage error %.5f\n", error);
  EXPECT_LT(error, 0.045);  // .071 where rows lie along most of them
}

// Also where it passes corners of tiles and of blocks, and where its round ends lie in another tile than its axis.
TEST(Tiles, ObliqueStrand_CoversItsArea) {
  for (float slope : {1.0f, 2.1f})
    for (float width : {0.2f, 0.6f}) {
      Drawing drawing;
      double area = 0, sum = 0;
      for (int k = -6; k <= 6; ++k) {
        const glm::vec3 middle(0.47f * float(k), -0.31f * float(k), 0);
        const glm::vec3 half = 0.9f * glm::normalize(glm::vec3(1, slope, 0));
        drawing.strand({middle - half, middle + half}, 0.5f * width * drawing.pixel(), k_red);
        const double length = 1.8 / double(drawing.pixel());
        area += double(width) * length + std::numbers::pi / 4 * double(width * width);
      }
      const Drawn drawn = draw(drawing);
      for (int y = 0; y < drawing.size; ++y)
        for (int x = 0; x < drawing.size; ++x) sum += double(drawn.alpha(x, y));
      std::printf("slope %g, %g px wide: %.5f of its area\n", double(slope), double(width), sum / area);
      EXPECT_NEAR(sum / area, 1, 0.0025) << slope << " " << width;
    }
}

// F10: all that is drawn of a quarter of the strands covers what all of them do, and the others are not even seen.
TEST(Tiles, LevelOfDetail_DrawsAPrefixThatCoversTheSameArea) {
  Drawing drawing;
  for (int k = 0; k < 64; ++k) {
    const float x = (float(k * 37 % 64) - 31.5f) * 0.11f;
    drawing.strand({{x, -3, 0}, {x, 3, 0}}, 0.1f * drawing.pixel(), k_red);
  }
  const Image none = make_image(drawing.size, drawing.size, {"R", "G", "B", "A"});
  const double all = mean_difference(draw(drawing).color, none, 3, 4);
  drawing.full_px = 4 * strands::covered_pixels({{-4, -4, -1}, {4, 4, 1}}, drawing.camera());
  const Drawn part = draw(drawing);
  EXPECT_EQ(std::ranges::count(part.seen, true), 2 * 16);
  EXPECT_NEAR(mean_difference(part.color, none, 3, 4) / all, 1, 0.04);  // measured: 1.026, for they overlap less
}

TEST(Tiles, EveryRepeat_HasTheSameBits) {
  Drawing drawing = bundle(200);
  for (int slices : {0, 40}) {
    drawing.slices = slices;
    Tiles tiles(drawing);
    const Drawn first = tiles.draw(), again = tiles.draw(), anew = draw(drawing);
    EXPECT_EQ(first.color.pixels, again.color.pixels);
    EXPECT_EQ(first.depth, again.depth);
    EXPECT_EQ(first.color.pixels, anew.color.pixels);
  }
}

// The invocations of a tile draw lists of their own; one that is done waits for the others.
TEST(Tiles, FarthestOfATile_IsBlendedOnceWhereFewerLieBeforeIt) {
  Drawing drawing;
  drawing.opacity = 0.4;
  drawing.strand({{-3, 0, -1}, {3, 0, -1}}, 2, k_red);
  const float x = 13.5f * drawing.pixel();
  for (int k = 1; k <= 9; ++k)
    drawing.strand({{x, -0.6f, 0.01f * float(k)}, {x, 0.6f, 0.01f * float(k)}}, 0.1f, k_green);
  const Drawn drawn = draw(drawing);
  EXPECT_GT(drawn.color.at(45, 31, 1), 0.9f);
  for (int px = 33; px < 40; ++px)
    for (int c : {0, 3}) EXPECT_NEAR(drawn.color.at(px, 31, c), 0.4f, 1e-4f) << px << " " << c;
}

TEST(Tiles, Depth_IsThatOfTheStrand) {
  Drawing drawing;
  drawing.strand({{-5, 0, 1}, {5, 0, 1}}, 4 * drawing.pixel(), k_red);
  const glm::dvec4 clip = projection_matrix(drawing.camera()) * view_matrix(drawing.camera()) * glm::dvec4(0, 0, 1, 1);
  for (int slices : {0, 8}) {
    drawing.slices = slices;
    const Drawn drawn = draw(drawing);
    EXPECT_NEAR(double(drawn.depth[std::size_t(32 * drawing.size + 32)]), clip.z / clip.w, 1e-5);
    EXPECT_EQ(drawn.depth[0], 1.0f);
  }
}

TEST(Tiles, StrandBehindTheScene_IsHidden) {
  Drawing drawing;
  drawing.strand({{-5, 0, 0}, {5, 0, 0}}, 4 * drawing.pixel(), k_red);
  const Drawn alone = draw(drawing);
  drawing.has_scene = true;
  drawing.scene_depth = alone.depth[std::size_t(32 * drawing.size + 32)] + 1e-3f;
  EXPECT_EQ(draw(drawing).color.pixels, alone.color.pixels);
  drawing.scene_depth -= 2e-3f;
  for (float value : draw(drawing).color.pixels) ASSERT_EQ(value, 0);
}

TEST(Tiles, StrandBehindTheScene_DoesNotShineThroughOneBefore) {
  Drawing drawing;
  drawing.opacity = 0.4;
  drawing.has_scene = drawing.has_gap = true;
  drawing.scene_depth = 0.9f;  // between the two
  drawing.strand({{-5, 0, 0}, {5, 0, 0}}, 4 * drawing.pixel(), k_red);
  drawing.strand({{-9, 0, -2}, {9, 0, -2}}, 4 * drawing.pixel(), k_green);
  for (int slices : {0, 8}) {
    drawing.slices = slices;
    const Drawn drawn = draw(drawing);
    EXPECT_NEAR(drawn.alpha(60, 32), 0.4, 1e-3);
    EXPECT_NEAR(drawn.alpha(63, 32), 1 - 0.6 * 0.6, 1e-3) << "in the gap";
  }
}

TEST(Tiles, SeenVertices_AreThoseInViewBeforeTheScene) {
  Drawing drawing;
  drawing.has_scene = true;
  drawing.scene_depth = 0.9f;  // 1 / (2 - 0.9 (2 - 1/50)) = 4.587 m from the eye
  const float thin = 0.5f * drawing.pixel();
  drawing.strand({{-1, 0, 0}, {1, 0, 0}}, thin, k_red);
  drawing.strand({{-1, 0, -2}, {1, 0, -2}}, thin, k_red);                      // behind the scene
  drawing.strand({{9, 0, 0}, {9, 3, 0}}, thin, k_red);                         // beside the view
  drawing.strand({{0, 0, 0}, {0, 3, 0}, {0, 9, 0}, {0, 12, 0}}, thin, k_red);  // leaves the view
  EXPECT_EQ(draw(drawing).seen, (std::vector<bool>{true, true, false, false, false, false, true, true, true, false}));
}

TEST(Tiles, StrandsAtTheNearPlane_AreCutThere) {
  Drawing drawing;
  drawing.strand({{-3, 1, 6}, {3, 1, 6}}, 0.1f, k_red);        // behind the eye
  drawing.strand({{-3, 1, 4}, {3, 1, 4}}, 0.1f, k_red);        // at the eye
  drawing.strand({{-3, 1, 3.6f}, {3, 1, 3.6f}}, 0.1f, k_red);  // before the near plane
  for (float value : draw(drawing).color.pixels) ASSERT_EQ(value, 0);
  drawing.strand({{-0.4f, -0.3f, 3.5f}, {0.4f, -0.3f, 3.5f}}, 0.02f, k_red);  // on it
  drawing.strand({{0.3f, 0.4f, 9}, {-1, 2, -3}}, 0.05f, k_green);             // across it
  const Drawn drawn = draw(drawing);
  for (float value : drawn.color.pixels) ASSERT_TRUE(std::isfinite(value));
  const Image truth = drawing.truth();
  const Image none = make_image(drawing.size, drawing.size, {"R", "G", "B", "A"});
  const double covered = mean_difference(truth, none, 3, 4), error = mean_difference(drawn.color, truth, 3, 4);
  std::printf("near plane: covered %.5f, error %.5f\n", covered, error);
  EXPECT_GT(covered, 0.03);
  EXPECT_LT(error, 0.1 * covered);
}

TEST(Tiles, CameraInsideTheHair_SeesWhatIsBeforeIt) {
  Drawing drawing = tests::around_the_camera();
  const Drawn drawn = draw(drawing);
  const Image truth = drawing.truth();
  const double error = mean_difference(drawn.color, truth, 3, 4);
  std::printf("camera inside: error %.5f\n", error);
  for (float value : drawn.color.pixels) ASSERT_TRUE(std::isfinite(value));
  EXPECT_LT(error, 0.03);
}

TEST(Tiles, StrandWithoutWidth_DrawsNothing) {
  Drawing drawing;
  drawing.strand({{-3, 0, 0}, {3, 0, 0}}, 0, k_red);
  for (float value : draw(drawing).color.pixels) ASSERT_EQ(value, 0);
}

TEST(Tiles, NumbersThatAreNone_AreLeftOutAndCounted) {
  Drawing drawing = bundle(20);
  const Drawn clean = draw(drawing);
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  drawing.strand({{-3, nan, 0}, {3, 0, 0}}, 0.1f, k_red);
  drawing.strand({{-3, 0, 0}, {3, 0, infinity}}, 0.1f, k_red);
  drawing.strand({{-3, 0, 0}, {3, 0, 0}}, nan, k_red);
  const Drawn drawn = draw(drawing);
  EXPECT_EQ(drawn.color.pixels, clean.color.pixels);
  ASSERT_EQ(drawn.notes.size(), 1u);
  EXPECT_EQ(drawn.notes[0].substr(0, 17), "tiles: 3 segments");
}

TEST(Tiles, PictureOfAnySize_IsWhole) {
  for (int size : {1, 7, 13, 64}) {
    Drawing drawing;
    drawing.size = size;
    drawing.strand({{-30, 0, 0}, {30, 0, 0}}, 40, k_green);
    const Drawn drawn = draw(drawing);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) ASSERT_NEAR(drawn.alpha(x, y), 1, 1e-3) << size;
  }
}

// As many strands at one depth as in one pixel: 1 - (1 - c)^n, where c is the share of a pixel that one covers.
TEST(Tiles, ManyStrandsInOnePixel_CompositeAll) {
  Drawing drawing;
  drawing.coverage_rows = 0;
  const int strands = 100000;
  const float thin = 2e-5f * drawing.pixel(), middle = 0.5f * drawing.pixel();
  for (int k = 0; k < strands; ++k) drawing.strand({{-1, middle, 0}, {1, middle, 0}}, 0.5f * thin, k_red);
  const Drawn drawn = draw(drawing);
  EXPECT_NEAR(drawn.alpha(32, 31), 1 - std::pow(1 - 2e-5, strands), 2e-3);
}

// By samples as many at random places, each far thinner than samples are apart.
TEST(Tiles, ManyThinStrandsInOnePixel_CoverWhatTheyShould) {
  Drawing drawing;
  const int strands = 100000;
  const float thin = 2e-5f * drawing.pixel();
  for (int k = 0; k < strands; ++k) {
    const float at = std::fmod(float(k) * 0.618034f, 1.0f) * drawing.pixel();
    drawing.strand({{-1, at, 0}, {1, at, 0}}, 0.5f * thin, k_red);
  }
  EXPECT_GT(draw(drawing).alpha(32, 31), 0.99);  // side by side, so that the pixel is covered twice over
}

}  // namespace
}  // namespace cuticle::render::tiles_gpu_test
