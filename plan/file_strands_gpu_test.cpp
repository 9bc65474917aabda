// The picture is of the groom that the file gives: its strands, vertices and radii, by every way of drawing.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "core/random.h"
#include "plan/traced_scene_runner.h"
#include "strands/formats/formats.h"
#include "strands/spline/place.h"
#include "tests/support/small_frames.h"

namespace cuticle::plan::file_strands_gpu_test {
namespace {

using namespace tests;

std::string written(const strands::Groom& groom, const std::string& name) {
  const auto folder = std::filesystem::path(CUTICLE_BINARY_DIR) / "file_strands_gpu_test";
  std::filesystem::create_directories(folder);
  const std::string path = (folder / name).string();
  const auto lost = strands::write_groom(path, groom);
  EXPECT_TRUE(lost) << (lost ? "" : lost.error().message);
  return path;
}

/// Arcs in a ball of 10 cm that run in every direction, of `sizes` vertices in turn, thinner towards their tips.
strands::Groom arcs(int strands, std::initializer_list<int> sizes, float radius) {
  strands::Groom groom;
  for (int s = 0; s < strands; ++s) {
    RandomStream chance(7, std::uint64_t(s));
    const auto within = [&] {
      return glm::vec3(chance.next_unit() - 0.5, chance.next_unit() - 0.5, chance.next_unit() - 0.5);
    };
    const glm::vec3 root = 0.1f * within(), along = 0.06f * glm::normalize(within()), bend = 0.03f * within();
    const int size = sizes.begin()[std::size_t(s) % sizes.size()];
    for (int k = 0; k < size; ++k) {
      const float t = float(k) / float(size - 1);
      groom.positions.push_back(root + t * along + t * t * bend);
      groom.radii.push_back(radius * (1 - 0.4f * t) * (1 + 0.3f * float(s % 3)));
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  return groom;
}

constexpr std::string_view k_view =
    R"("camera": {"position_m": [0.05, 0.1, 0.6], "target_m": [0, 0, 0], "fov_deg": 20, "resolution_px": [128, 128]})";

std::string of_file(const std::string& path, std::string_view more = "") {
  return fmt::format(R"("groom": {{"file": "{}", "metres_per_unit": 1{}}})", path, more);
}

std::unique_ptr<FrameRunner> runner_of(const std::string& groom, std::string_view method,
                                       std::string_view more = R"("name": "x")") {
  std::string text = fmt::format(R"({{"schema_version": 1, {}, {}, {}, {}}})", groom, method, k_view, more);
  const auto scene = scene::parse_scene(text, "/", "test", plan::catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  auto made = FrameRunner::create(device(), *scene, silent_progress());
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return std::move(*made);
}

strands::Groom drawn_by(FrameRunner& runner) {
  frame_of(runner, 0);
  auto drawn = runner.drawn_strands();
  EXPECT_TRUE(drawn);
  return *drawn;
}

TEST(StrandsOfAFile, InThePicture_AreThoseOfTheFileWithTheirVerticesAndRadii) {
  const strands::Groom groom = arcs(37, {9, 2, 32}, 40e-6f);
  const std::string path = written(groom, "uneven.npz");
  for (std::string_view method : {k_lines, k_quads, k_tiles, k_supersampled}) {
    const strands::Groom drawn = drawn_by(*runner_of(of_file(path), method));
    EXPECT_EQ(drawn.offsets, groom.offsets) << method;
    EXPECT_EQ(drawn.positions, groom.positions) << method;
    EXPECT_EQ(drawn.radii, groom.radii) << method;
  }
}

TEST(StrandsOfAFile, WithSegmentsCutIntoParts_KeepTheVerticesOfTheFile) {
  const strands::Groom groom = arcs(37, {9, 2, 32}, 40e-6f);
  const std::string path = written(groom, "cut.npz");
  const strands::Groom drawn = drawn_by(*runner_of(of_file(path, R"(, "segment_parts": 4)"), k_tiles));
  EXPECT_EQ(drawn.offsets, groom.offsets);
  EXPECT_EQ(drawn.positions, groom.positions);
  EXPECT_EQ(drawn.radii, groom.radii);
}

// A running scene that is given a level of detail draws what one that was opened with it does: the first strands of a
// file may all lie on one side.
TEST(StrandsOfAFile, OfASceneThatIsGivenALevelOfDetail_AreSpreadOverAll) {
  const std::string path = written(arcs(200, {9}, 40e-6f), "level.npz");
  const auto scene = [&](double full_px) {
    return *scene::parse_scene(
        fmt::format(R"({{"schema_version": 1, {}, {}, {}, "passes": {{"tile_lists": {{"full_px": {}}}}}}})",
                    of_file(path), k_tiles, k_view, full_px),
        "/", "test", plan::catalogue());
  };
  const auto opened = *FrameRunner::create(device(), scene(50000), silent_progress());
  const auto changed = *FrameRunner::create(device(), scene(0), silent_progress());
  const Image all = frame_of(*changed, 0).color;
  ASSERT_TRUE(changed->change(scene(50000), silent_progress()));
  EXPECT_EQ(frame_of(*changed, 0).color.pixels, frame_of(*opened, 0).color.pixels);
  EXPECT_NE(frame_of(*changed, 0).color.pixels, all.pixels);
}

TEST(StrandsOfAFile, ThatAsksForStrandsBetween_AreSmoothedAndAsManyAsAsked) {
  const std::string path = written(arcs(37, {9}, 40e-6f), "even.npz");
  const strands::Groom drawn = drawn_by(
      *runner_of(of_file(path, R"(, "interpolate": true)"), k_tiles, R"("strand_count": 100, "strand_vertices": 12)"));
  EXPECT_EQ(drawn.strand_count(), 100u);
  EXPECT_EQ(drawn.vertex_count(), 1200u);
}

TEST(StrandsOfAFile, TaperOfTheScene_ThinsTipsAlone) {
  const strands::Groom groom = arcs(5, {9}, 40e-6f);
  const std::string path = written(groom, "taper.npz");
  const strands::Groom drawn = drawn_by(*runner_of(of_file(path, R"(, "taper": 0.75)"), k_tiles));
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    EXPECT_EQ(drawn.radii[drawn.offsets[s]], groom.radii[groom.offsets[s]]);
    EXPECT_NEAR(drawn.radii[drawn.offsets[s + 1] - 1], 0.25f * groom.radii[groom.offsets[s + 1] - 1], 1e-10f);
  }
}

double coverage(const Image& picture) {
  double sum = 0;
  for (std::size_t p = 3; p < picture.pixels.size(); p += 4) sum += double(picture.pixels[p]);
  return sum;
}

/// The same strands with a vertex added in the middle of each segment of those of few vertices.
strands::Groom refined_to(std::size_t size, const strands::Groom& groom) {
  strands::Groom fine;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const std::size_t own = groom.strand_size(s), parts = (size - 1) / (own - 1);
    for (std::size_t k = 0; k + 1 < own; ++k)
      for (std::size_t p = 0; p < parts; ++p) {
        const float t = float(p) / float(parts);
        const std::size_t at = groom.offsets[s] + k;
        fine.positions.push_back(glm::mix(groom.positions[at], groom.positions[at + 1], t));
        fine.radii.push_back(groom.radii[at] + t * (groom.radii[at + 1] - groom.radii[at]));
      }
    fine.positions.push_back(groom.strand(s).back());
    fine.radii.push_back(groom.radii[groom.offsets[s + 1] - 1]);
    fine.offsets.push_back(std::uint32_t(fine.positions.size()));
  }
  return fine;
}

// Rows of the longest strand end in vertices of a shorter one's tip: these cover nothing and cast nothing.
TEST(StrandsOfAFile, ShorterThanTheLongest_CoverAndShadowAsThoseCutIntoAsManySegments) {
  const strands::Groom groom = arcs(400, {5, 9, 17}, 100e-6f), even = refined_to(17, groom);
  ASSERT_EQ(even.vertex_count(), 400u * 17u);
  const std::string uneven_path = written(groom, "mixed.npz"), even_path = written(even, "cut.npz");
  constexpr std::string_view lit = R"("lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}],
    "passes": {"lines": {"ambient": 0}}, "shadow": {"method": {"deep_opacity": {"resolution": 128}}, "fibre_alpha": 0.4})";
  for (std::string_view method : {k_lines, k_quads, k_tiles}) {
    const auto drawn = [&](const std::string& path) {
      return frame_of(*runner_of(of_file(path, R"(, "segment_parts": 1)"), method, lit), 0).color;
    };
    const Image a = drawn(uneven_path), b = drawn(even_path);
    EXPECT_NEAR(coverage(a) / coverage(b), 1, 5e-3) << method;  // measured: .0012, .0002, .0031
    double light_a = 0, light_b = 0;
    for (std::size_t p = 0; p < a.pixels.size(); p += 4) light_a += double(a.pixels[p]), light_b += double(b.pixels[p]);
    fmt::print("{}: coverage {:.4f}, light {:.4f} of those cut\n", method, coverage(a) / coverage(b),
               light_a / light_b);
    EXPECT_NEAR(light_a / light_b, 1, 0.02) << method;
  }
}

// Of a segment that shows in part, the parts behind other hair are not shaded.
TEST(StrandsOfAFile, InPartsThatDoNotShow_GiveTheSamePicture) {
  const std::string path = written(arcs(2000, {5, 12}, 900e-6f), "hidden_parts.npz");
  constexpr std::string_view lit = R"("lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}],
    "material": {"model": {"kajiya_kay": {}}, "evaluate": "direct"}, "shadow": {"method": {"shadow_map": {"resolution": 128}}})";
  const auto drawn = [&](std::string_view passes) {
    return frame_of(*runner_of(of_file(path, R"(, "segment_parts": 8)"), k_tiles, fmt::format("{}{}", lit, passes)), 0);
  };
  constexpr std::string_view whole = R"("tile_lists": {"whole_segments": true})";
  const FrameResult few = drawn(fmt::format(R"(, "passes": {{{}}})", whole)),
                    all = drawn(fmt::format(R"(, "passes": {{{}, "seen_vertices": {{"wanted": false}}}})", whole));
  EXPECT_TRUE(few.color.pixels == all.color.pixels);
  int shaded = -1, count = -1;
  for (const std::string& note : few.notes) std::sscanf(note.c_str(), "seen_vertices: %d of %d", &shaded, &count);
  fmt::print("{} of {} vertices shaded\n", shaded, count);
  EXPECT_EQ(count, 2000 * (11 * 8 + 1));
  EXPECT_GT(shaded, 0.05 * count);
  EXPECT_LT(shaded, 0.5 * count);
}

// Measured: 1; where each part is a line of its own .923 and .959.
TEST(Lines, SegmentsCutIntoParts_CoverAsMuchAsWholeOnes) {
  for (const float radius : {1e-4f, 4e-4f}) {
    const std::string path = written(arcs(60, {12}, radius), "parts.npz");
    const auto covered = [&](std::string_view more) {
      return coverage(frame_of(*runner_of(of_file(path, more), k_lines), 0).color);
    };
    const double whole = covered(""), cut = covered(R"(, "segment_parts": 8)");
    fmt::print("{:.0f} um: cut segments cover {:.4f} of whole ones\n", 1e6f * radius, cut / whole);
    EXPECT_NEAR(cut / whole, 1, 1e-3);
  }
}

// Strands from a tenth of a pixel to a pixel wide, few and many, against brute force.
TEST(Lines, ThinnerThanAPixel_CoverAsMuchAsTheTruth) {
  for (const auto& [strands, radius] : {std::pair{60, 80e-6f}, {60, 300e-6f}, {4000, 80e-6f}, {4000, 300e-6f}}) {
    const std::string path = written(arcs(strands, {12}, radius), fmt::format("lines_{}.npz", strands));
    const double lines = coverage(frame_of(*runner_of(of_file(path), k_lines), 0).color),
                 truth = coverage(frame_of(*runner_of(of_file(path), k_supersampled), 0).color);
    fmt::print("{} strands of {:.0f} um: lines cover {:.4f} of the truth's {:.0f} pixels\n", strands, 1e6f * radius,
               lines / truth, truth);
    EXPECT_NEAR(lines / truth, 1, 0.03) << strands << " " << radius;
  }
}

/// The last coordinate of a Cem Yuksel file as a number that is none.
std::string with_nan(const std::string& path) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(-4, std::ios::end);
  const float none = std::numeric_limits<float>::quiet_NaN();
  file.write(reinterpret_cast<const char*>(&none), 4);
  return path;
}

TEST(StrandsOfAFile, WithNaN_AreRefusedByTheDeviceAsByTheCpu) {
  const std::string path = with_nan(written(arcs(5, {9}, 40e-6f), "nan.hair"));
  for (std::string_view method : {k_lines, k_tiles, k_quads, k_cards, k_supersampled}) {
    const auto scene = scene::parse_scene(fmt::format(R"({{"schema_version": 1, {}, {}}})", of_file(path), method), "/",
                                          "test", plan::catalogue());
    ASSERT_TRUE(scene);
    const auto on_device = FrameRunner::create(device(), *scene, silent_progress());
    const auto on_cpu = TracedSceneRunner::create(*scene, silent_progress());
    ASSERT_FALSE(on_device) << method;
    ASSERT_FALSE(on_cpu) << method;
    EXPECT_EQ(on_device.error().message, on_cpu.error().message) << method;
    EXPECT_THAT(on_device.error().message, testing::HasSubstr("nan.hair"));
  }
}

TEST(StrandsOfAFile, WithCountsOfGrownHair_SayThatTheyAreNotUsed) {
  const std::string path = written(arcs(5, {9}, 40e-6f), "counts.npz");
  const auto scene =
      scene::parse_scene(fmt::format(R"({{"schema_version": 1, {}, "strand_count": 900}})", of_file(path)), "/", "test",
                         plan::catalogue());
  ASSERT_TRUE(scene);
  EXPECT_THAT(scene->notes, testing::ElementsAre(testing::HasSubstr("strand_count is not used")));
}

}  // namespace
}  // namespace cuticle::plan::file_strands_gpu_test
