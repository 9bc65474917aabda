// What pixels see of each strand: by every way of drawing that can tell, against the picture and against each other.
#include <filesystem>
#include <map>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "strands/formats/formats.h"
#include "tests/support/small_frames.h"

namespace cuticle::plan::seen_strands_gpu_test {
namespace {

using namespace tests;

constexpr std::string_view k_outputs = R"("outputs": {"deep": true, "cryptomatte": true})";
constexpr std::string_view k_paths = R"("passes": {"reference": {"samples": 16, "bounces": 1}})";
constexpr std::string_view k_rows = R"("passes": {"tiles": {"coverage_rows": 16}})";
constexpr std::string_view k_reference = R"("render": {"method": "reference"})";

/// Sheaves of strands that cross before each other, without a head; `in_all_directions`: every second one lies across.
std::string hair_alone(bool in_all_directions = false) {
  strands::Groom groom;
  for (int s = 0; s < 300; ++s) {
    RandomStream chance(11, std::uint64_t(s));
    const float x = float(chance.next_unit()) - 0.5F, y = float(chance.next_unit()) - 0.5F,
                z = float(chance.next_unit());
    for (int k = 0; k < 8; ++k) {
      const float t = float(k) / 7;
      glm::vec3 point(0.2F * x + 0.08F * (t - 0.5F), 0.2F * (t - 0.5F) + 0.05F * y * t * t, 0.1F * z);
      if (in_all_directions && s % 2 == 1) std::swap(point.x, point.y);
      groom.positions.push_back(point);
      groom.radii.push_back(0.0015F * (1 - 0.5F * t));
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  const auto folder = std::filesystem::path(CUTICLE_BINARY_DIR) / "seen_strands_gpu_test";
  std::filesystem::create_directories(folder);
  const std::string path = (folder / (in_all_directions ? "crossing.npz" : "sheaves.npz")).string();
  EXPECT_TRUE(strands::write_groom(path, groom));
  return fmt::format(R"("groom": {{"file": "{}", "metres_per_unit": 1}})", path);
}

FrameResult frame_by(std::initializer_list<std::string_view> parts) { return frame_of(*runner(parts), 0); }

/// Light and share of the strands in each pixel.
std::vector<glm::dvec4> sums_of(const FrameResult& frame) {
  std::vector<glm::dvec4> sums(frame.color.pixels.size() / 4, glm::dvec4(0));
  for (const SeenShare& share : frame.shares)
    if (share.object > 0) sums[share.pixel] += glm::dvec4(share.light);
  return sums;
}

/// Of pixels whose picture holds hair alone, the largest difference from it, and how many there are.
std::pair<double, int> apart_from_picture(const FrameResult& frame) {
  const std::vector<glm::dvec4> sums = sums_of(frame);
  double largest = 0;
  int pixels = 0;
  for (std::size_t p = 0; p < sums.size(); ++p) {
    if (sums[p].w == 0) continue;
    ++pixels;
    for (int c = 0; c < 4; ++c)
      largest = std::max(largest, std::abs(sums[p][c] - double(frame.color.pixels[4 * p + std::size_t(c)])));
  }
  return {largest, pixels};
}

TEST(SeenStrands, WithoutAHead_AddUpToThePictureWithinAThousandth) {
  const std::string hair = hair_alone();
  for (const auto& [method, passes] :
       {std::pair(k_tiles, std::string_view(R"("passes": {})")),
        std::pair(k_tiles, std::string_view(R"("passes": {"tiles": {"coverage_rows": 0}})")),
        std::pair(k_tiles, std::string_view(R"("passes": {"tile_lists": {"lanes": 64}})")),
        std::pair(k_supersampled, std::string_view(R"("passes": {"supersampled": {"samples": 8}})")),
        std::pair(k_reference, k_paths)}) {
    const FrameResult frame = frame_by({k_light, hair, method, passes, k_outputs});
    const auto [largest, pixels] = apart_from_picture(frame);
    std::printf("%s: %.6f over %d pixels\n", std::string(method).c_str(), largest, pixels);
    EXPECT_GT(pixels, 500) << method;
    EXPECT_LT(largest, 1e-3) << method;
  }
}

// Tiles of such hair are drawn three times, and each tells what it saw.
TEST(SeenStrands, InAllDirections_AddUpToThePictureWithinAThousandth) {
  const std::string hair = hair_alone(true);
  for (const std::string_view passes : {R"("passes": {})", R"("passes": {"tile_lists": {"lanes": 64}})",
                                        R"("passes": {"tiles": {"coverage_rows": 3}})"}) {
    const auto [largest, pixels] = apart_from_picture(frame_by({k_light, hair, k_tiles, passes, k_outputs}));
    std::printf("%s: %.6f over %d pixels\n", std::string(passes).c_str(), largest, pixels);
    EXPECT_GT(pixels, 500) << passes;
    EXPECT_LT(largest, 1e-3) << passes;
  }
}

std::map<std::pair<std::uint32_t, std::uint32_t>, double> shares_of(const FrameResult& frame) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> shares;
  for (const SeenShare& share : frame.shares)
    if (share.object > 0) shares[{share.pixel, share.object}] += double(share.light.w);
  return shares;
}

TEST(SeenStrands, ByTiles_AreThoseOfBruteForce) {
  const std::string hair = hair_alone();
  const auto tiles = shares_of(frame_by({k_light, hair, k_tiles, k_rows, k_outputs}));
  const auto brute = shares_of(frame_by({k_light, hair, k_supersampled, k_outputs}));
  double apart = 0, all = 0;
  for (const auto& [place, share] : brute) {
    const auto found = tiles.find(place);
    apart += std::abs(share - (found == tiles.end() ? 0 : found->second));
    all += share;
  }
  std::printf("%.4f of the shares\n", apart / all);
  EXPECT_LT(apart, 0.13 * all);
}

TEST(SeenStrands, DeepPicture_LaidOverEachOtherIsThePictureWithItsHead) {
  FrameResult frame = frame_by({k_light, k_tiles, k_outputs});
  const Image flat = flatten(deep_image({frame.color.width, frame.color.height}, std::move(frame.shares)));
  for (std::size_t k = 0; k < flat.pixels.size(); ++k) ASSERT_NEAR(flat.pixels[k], frame.color.pixels[k], 1e-3) << k;
}

std::string refusal_of(std::initializer_list<std::string_view> parts) {
  const auto refused = FrameRunner::create(device(), scene_of(parts), silent_progress());
  return refused ? "it is not refused" : refused.error().message;
}

TEST(SeenStrands, SceneThatCannotTell_IsRefusedBeforeItIsDrawn) {
  EXPECT_THAT(refusal_of({k_light, k_tiles, k_outputs, R"("passes": {"depth_of_field": {"lens_radius": 5}})"}),
              testing::HasSubstr("'depth_of_field' moves light between pixels"));
  EXPECT_THAT(refusal_of({k_light, k_lines, k_outputs}), testing::HasSubstr("'lines' does not tell strands apart"));
  EXPECT_THAT(refusal_of({k_light, k_tiles, k_outputs, R"("passes": {"tiles": {"chunk_px": 32}})"}),
              testing::HasSubstr("so large a picture is drawn in parts"));
}

TEST(SeenStrands, RunningSceneThatCannotTellAnyMore_KeepsTheFormer) {
  const auto made = runner({k_light, k_tiles, k_outputs});
  EXPECT_FALSE(made->change(scene_of({k_light, k_lines, k_outputs}), silent_progress()));
  EXPECT_TRUE(made->run(0));
}

}  // namespace
}  // namespace cuticle::plan::seen_strands_gpu_test
