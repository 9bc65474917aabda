// Cards: a pixel beside the model in double, the schemes beside each other, the order beside compositing by hand.
#include "tests/support/card_pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "bsdf/scheuermann/shading.h"
#include "render/passes/cards/sorting_gpu.h"

namespace cuticle::render::cards_gpu_test {
namespace {

/// The atlas as a device samples it: bilinear, clamped.
glm::dvec4 sampled(const Image& atlas, glm::dvec2 uv) {
  const glm::dvec2 place = uv * glm::dvec2(atlas.width, atlas.height) - 0.5;
  const glm::dvec2 low = glm::floor(place), share = place - low;
  glm::dvec4 sum(0);
  for (int k = 0; k < 4; ++k) {
    const int x = std::clamp(int(low.x) + k % 2, 0, atlas.width - 1),
              y = std::clamp(int(low.y) + k / 2, 0, atlas.height - 1);
    const double weight = (k % 2 ? share.x : 1 - share.x) * (k / 2 ? share.y : 1 - share.y);
    for (int c = 0; c < 4; ++c) sum[c] += weight * double(atlas.at(x, y, c));
  }
  return sum;
}

/// One opaque card that hangs before the eye, seen and lit at a slant: its middle pixel is what the model makes of the
/// texel and the occlusion there.
TEST(Cards, PixelOfACard_EqualsTheModelWithTexelAndOcclusion) {
  Scene scene;
  for (int s = 0; s < 5; ++s) add_strand(scene.groom, {0.01f * float(s - 2), 0, 0.5f}, {0, -0.025f, 0}, 0.02f);
  scene.settings = {{"cards", std::int64_t(1)}, {"layers", std::int64_t(1)}, {"width", 0.04}};
  scene.material =
      "base=0.9/0.7/0.5,diffuse=0.1,primary=0.3/0.2/0.4,primary_exponent=30,secondary=0.2,secondary_exponent=8";
  const auto made = strands::make_hair_cards(scene.groom, &scene.head,
                                             registry::from_values<cards::Parameters>(parameters_of(scene)));
  ASSERT_TRUE(made);
  const auto values =
      *registry::parse_assignments((*bsdf::find_model("scheuermann"))->entry.parameters, scene.material);
  const strands::CardRow& row = made->mesh.rows[made->mesh.rows.size() / 2];
  const glm::dvec3 t(row.tangent), n(row.normal());
  const glm::dvec4 texel = sampled(made->textures.atlas, made->textures.atlas_uv(0, 0.5f, row.v));
  const double open =
      0.5 * double(made->occlusion[made->mesh.rows.size() - 1] + made->occlusion[made->mesh.rows.size()]);
  EXPECT_LT(open, 0.99);
  double worst = 0;
  for (double slant : {-0.5, 0.0, 0.7})
    for (const glm::dvec3& to_light :
         {glm::dvec3(0.3, 0.2, 1), glm::dvec3(-0.5, 0.9, 0.3), glm::dvec3(0.2, -0.3, -1)}) {
      scene.camera.target = glm::dvec3(row.middle);
      scene.camera.position = scene.camera.target + 0.5 * (std::cos(slant) * n + std::sin(slant) * t);
      scene.lights[0].to_light = glm::normalize(to_light);
      const glm::dvec3 l = scene.lights[0].to_light, side = glm::cross(t, n);
      const bsdf::Point at{
          .theta_i = std::asin(glm::dot(l, t)), .theta_o = slant, .phi = std::atan2(glm::dot(l, side), glm::dot(l, n))};
      const auto exact = bsdf::scheuermann::shaded_texel(
          values, {.base = glm::dvec3(0.9, 0.7, 0.5) * texel.x, .shift = texel.y, .noise = texel.z, .occlusion = open},
          scene.lights[0].irradiance, at);
      ASSERT_TRUE(exact);
      const Image image = draw(scene).image;
      // The middle of an even picture lies between four pixels.
      for (int c = 0; c < 3; ++c) {
        const double mean =
            0.25 * double(image.at(47, 47, c) + image.at(48, 47, c) + image.at(47, 48, c) + image.at(48, 48, c));
        worst = std::max(worst, std::abs(mean - (*exact)[c]) / std::max((*exact)[c], 0.01));
      }
    }
  std::printf("pixel beside the model: %.4f\n", worst);
  EXPECT_LT(worst, 0.015);
}

/// A lock of which the share v arrives at v: the card's pixels get dimmer toward the root as its strands do, and all of
/// it arriving is more light than occlusion leaves.
TEST(Cards, ShadowOfTheirStrands_DimsRowsInPlaceOfOcclusion) {
  Scene scene;
  add_lock(scene.groom, 0.1f, 5);
  scene.settings = {{"cards", std::int64_t(1)}, {"layers", std::int64_t(1)}};
  const Image occluded = draw(scene).image;
  scene.reached.assign(scene.groom.vertex_count(), 1);
  const Image open = draw(scene).image;
  for (std::size_t v = 0; v < scene.reached.size(); ++v)
    scene.reached[v] = float(v % k_vertices) / float(k_vertices - 1);
  const Image graded = draw(scene).image;
  double worst = 0;
  int seen = 0;
  for (int y = 0; y < k_size; ++y)
    for (int x = 0; x < k_size; ++x) {
      if (open.at(x, y, 3) < 0.9f) continue;
      ++seen;
      // One metre away, looking at y = -0.1 with 0.4 rad over the picture; the lock lies at 0.1 m, from y = 0 to -0.2.
      const double down = (double(y) + 0.5) / k_size * 2 - 1, place = -0.1 - down * std::tan(0.2) * 0.9;
      worst = std::max(worst, std::abs(double(graded.at(x, y, 0)) / double(open.at(x, y, 0)) - place / -0.2));
      EXPECT_LE(occluded.at(x, y, 0), open.at(x, y, 0) * 1.0001f);
    }
  std::printf("shadowed rows: %d pixels, share off by %.4f\n", seen, worst);
  EXPECT_GT(seen, 100);
  EXPECT_LT(worst, 0.004);
}

TEST(Cards, ThreeAndFourPasses_DrawTheSamePictureUnderEqualDepthRules) {
  Scene scene{.groom = locks()};
  scene.settings = {{"transparent_depth", std::string("off")}};
  const Image four = draw(scene).image;
  scene.settings.emplace_back("scheme", std::string("three_pass"));
  const Image three = draw(scene).image;
  EXPECT_GT(mean_difference(four, make_image(k_size, k_size, {"R", "G", "B", "A"}), 3, 4), 0.1);
  EXPECT_LT(largest_difference(three, four), 1e-5);
}

std::uint64_t all_shaded(const Drawn& drawn) {
  return drawn.shaded("cards: opaque") + drawn.shaded("cards: back faces") + drawn.shaded("cards: front faces");
}

TEST(Cards, DepthOfOpaquePartsFirst_SavesShading) {
  Scene scene{.groom = locks()};
  scene.settings = {{"count_fragments", true}, {"transparent_depth", std::string("off")}};
  const Drawn four = draw(scene);
  scene.settings.emplace_back("scheme", std::string("three_pass"));
  const Drawn three = draw(scene);
  std::printf("fragments shaded: %d by three passes, %d by four; of the opaque parts %d and %d\n",
              int(all_shaded(three)), int(all_shaded(four)), int(three.shaded("cards: opaque")),
              int(four.shaded("cards: opaque")));
  EXPECT_LT(double(four.shaded("cards: opaque")), 0.5 * double(three.shaded("cards: opaque")));
  EXPECT_LT(double(all_shaded(four)), 0.5 * double(all_shaded(three)));
  // One opaque texel is in front in a pixel.
  EXPECT_LE(four.shaded("cards: opaque"), std::uint64_t(k_size * k_size));
  if (!device()->info().fragment_counts) return;
  EXPECT_GE(four.covered("cards: depth"), four.shaded("cards: opaque"));
  EXPECT_EQ(three.covered("cards: depth"), 0u);
}

TEST(Cards, HeadDrawnFirst_HidesCardsBeforeTheyAreShaded) {
  Scene scene{.groom = locks()};
  scene.settings = {{"count_fragments", true}};
  // A wall through the head's middle, about which it lies evenly; not drawn at first.
  scene.head.positions = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
  scene.head.normals.resize(4, glm::vec3(0, 0, 1));
  scene.head.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Drawn bare = draw(scene);
  scene.draws_head = true;
  const Drawn hidden = draw(scene);
  EXPECT_EQ(hidden.image.at(2, 2, 3), 1);
  EXPECT_LT(double(hidden.shaded("cards: back faces")), 0.3 * double(bare.shaded("cards: back faces")));
  EXPECT_LT(all_shaded(hidden), all_shaded(bare));
}

/// B at 0.2 and A at 0.3 before the head's middle; A swings to behind B: the static order draws it last even so.
TEST(Cards, OrderAtRunTime_MendsWhatTheStaticOneGetsWrong) {
  Scene scene;
  add_lock(scene.groom, 0.2f, 1);
  add_lock(scene.groom, 0.3f, 2);
  scene.settings = {{"cards", std::int64_t(2)},
                    {"layers", std::int64_t(1)},
                    {"swings_from", 0.1},
                    {"fill", 0.0},
                    {"base_variation", 1.0}};
  const std::size_t half = scene.groom.vertex_count() / 2;
  const auto picture = [&](bool shows_b, bool shows_a, float a_moves, const char* order) {
    scene.moved = scene.groom.positions;
    for (std::size_t v = 0; v < scene.moved.size(); ++v) {
      if (v >= half) scene.moved[v].z += a_moves;
      if (v < half ? !shows_b : !shows_a) scene.moved[v].z += 10;  // behind the eye
    }
    Scene frame = scene;
    frame.settings.emplace_back("order", std::string(order));
    return draw(frame).image;
  };
  const auto over = [](Image front, const Image& back) {
    for (std::size_t p = 0; p < front.pixels.size(); ++p) {
      const float open = 1 - front.pixels[p / 4 * 4 + 3];
      front.pixels[p] += open * back.pixels[p];
    }
    return front;
  };
  const Image b = picture(true, false, 0, "static");
  const Image rest = over(picture(false, true, 0, "static"), b);
  EXPECT_LT(largest_difference(picture(true, true, 0, "static"), rest), 1e-5) << "at rest A is in front of B";
  const Image swung = over(b, picture(false, true, -0.2f, "static"));
  const double wrong = mean_difference(picture(true, true, -0.2f, "static"), swung, 0, 3);
  std::printf("static order of swung hair: mean error %.5f\n", wrong);
  EXPECT_GT(wrong, 1e-4);
  for (const char* order : {"groups", "cards"})
    EXPECT_LT(largest_difference(picture(true, true, -0.2f, order), swung), 1e-5) << order;
  // Three passes as printed write the depth of B's transparent parts: A, drawn later and behind, is left out there.
  scene.settings.emplace_back("scheme", std::string("three_pass"));
  EXPECT_GT(mean_difference(picture(true, true, -0.2f, "static"), swung, 0, 3), 1e-4);
  const Image printed = picture(true, true, -0.2f, "static");
  scene.settings.emplace_back("transparent_depth", std::string("off"));
  EXPECT_GT(mean_difference(picture(true, true, -0.2f, "static"), printed, 0, 4), 1e-4);
}

/// Parts as CPU and device order them, of two tails and the head's hair.
TEST(CardOrder, OfThisFrame_IsThatOfBruteForce) {
  strands::Groom groom = locks();
  for (int s = 0; s < 60; ++s)
    add_strand(groom, {s % 2 ? 0.1f : -0.1f, 0.0005f * float(s), 0}, {s % 2 ? 0.03f : -0.03f, 0, 0.01f}, 1e-3f);
  Scene scene{.groom = groom};
  scene.settings = {{"swings_from", 0.2}};
  const auto made =
      strands::make_hair_cards(groom, &scene.head, registry::from_values<cards::Parameters>(parameters_of(scene)));
  ASSERT_TRUE(made);
  std::vector<glm::vec4> placed;
  for (const strands::CardRow& row : made->mesh.rows)
    for (float side : {-1.0f, 1.0f, 0.0f, 0.0f})
      placed.emplace_back(row.middle + side * row.half_width * row.across, 1);
  const gpu::Buffer buffer = upload(placed);
  const Camera camera{.position = {0.7, 0.3, 0.6}, .target = {0, 0, 0}};
  const auto depth_of = [&](const strands::CardPart& part) {
    double sum = 0;
    for (std::uint32_t r = part.first_row; r < part.first_row + part.row_count; ++r)
      sum += glm::dot(glm::dvec3(made->mesh.rows[r].middle) - camera.position,
                      glm::normalize(camera.target - camera.position));
    return sum / part.row_count;
  };
  const auto group_depth = [&](std::uint32_t group) {
    double sum = 0, rows = 0;
    for (const strands::CardPart& part : made->mesh.parts)
      if (part.group == group) sum += depth_of(part) * part.row_count, rows += part.row_count;
    return sum / rows;
  };
  const std::size_t count = made->mesh.parts.size();
  EXPECT_GE(std::ranges::max_element(made->mesh.parts, {}, &strands::CardPart::group)->group, 2u);
  for (const cards::Order order : {cards::Order::inside_to_outside, cards::Order::groups, cards::Order::parts}) {
    std::vector<std::pair<std::pair<double, double>, std::size_t>> keys;
    for (std::size_t p = 0; p < count; ++p) {
      const strands::CardPart& part = made->mesh.parts[p];
      const bool is_static =
          order == cards::Order::inside_to_outside || (order == cards::Order::groups && part.group == 0);
      keys.push_back(
          {{order == cards::Order::groups ? -group_depth(part.group) : 0, is_static ? 0 : -depth_of(part)}, p});
    }
    std::ranges::sort(keys);
    std::vector<std::uint32_t> expected;
    for (const auto& [key, p] : keys)
      for (std::uint32_t t = 0; t < made->mesh.parts[p].triangle_count; ++t)
        for (std::uint32_t v : made->mesh.mesh.triangles[made->mesh.parts[p].first_triangle + t]) expected.push_back(v);
    const auto sorting = cards::Sorting::make(*device(), made->mesh, order);
    ASSERT_TRUE(sorting);
    gpu::Commands commands = device()->record();
    sorting->record(commands, camera, buffer);
    ASSERT_TRUE(device()->submit(std::move(commands)));
    EXPECT_EQ(*gpu::read_buffer<std::uint32_t>(*device(), sorting->indices(), expected.size()), expected) << int(order);
  }
}

TEST(Cards, TurnedWithHeadCameraAndLights_LookTheSame) {
  Scene scene{.groom = locks()};
  const Image rest = draw(scene).image;
  EXPECT_EQ(draw(scene).image.pixels, rest.pixels) << "a repeat";
  const glm::dmat4 turn =
      glm::translate(glm::rotate(glm::dmat4(1), 1.1, glm::normalize(glm::dvec3(1, 2, -1))), glm::dvec3(0.3, 0.1, -0.2));
  for (const glm::vec3& position : scene.groom.positions) scene.moved.emplace_back(turn * glm::dvec4(position, 1));
  scene.motion = turn;
  const auto moved = [&](const glm::dvec3& v, double w) { return glm::dvec3(turn * glm::dvec4(v, w)); };
  scene.camera = {.position = moved(scene.camera.position, 1),
                  .target = moved(scene.camera.target, 1),
                  .up = moved({0, 1, 0}, 0),
                  .vertical_field_of_view = 0.4};
  scene.lights[0].to_light = moved(scene.lights[0].to_light, 0);
  const double error = mean_difference(draw(scene).image, rest, 0, 4);
  std::printf("turned: mean difference %.6f\n", error);
  EXPECT_LT(error, 2e-3);
}

TEST(Cards, FibreOfMarschner_IsDrawnAndOtherModelsAreRefused) {
  Scene scene{.groom = locks(), .model = "marschner", .material = "sigma_a=0.1/0.3/0.6"};
  const Image image = draw(scene).image;
  EXPECT_GT(mean_difference(image, make_image(k_size, k_size, {"R", "G", "B", "A"}), 0, 1), 1e-3);
  scene.model = "kajiya_kay";
  scene.material = "";
  const auto refused = try_draw(scene);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("material.model = 'kajiya_kay'"), std::string::npos);
}

/// Locks of a fibre whose hair lets .4 of the light through and surfaces `past` of that.
Scene locks_behind_surfaces(float past) {
  Scene scene{.groom = locks(), .model = "marschner", .material = "sigma_a=0.1/0.3/0.6"};
  scene.reached.assign(scene.groom.vertex_count(), 0.4f * past);
  scene.past.assign(scene.groom.vertex_count(), past);
  return scene;
}

// No fibre scatters what a surface took away: a quarter of the light is a quarter of the radiance.
TEST(Cards, DualScatteringOfLightHalfBehindSurfaces_IsThatOfLessLight) {
  Scene whole = locks_behind_surfaces(1), part = locks_behind_surfaces(0.25f);
  whole.dual = part.dual = true;
  Image expected = draw(whole).image;
  EXPECT_GT(mean_difference(expected, make_image(k_size, k_size, {"R", "G", "B", "A"}), 0, 3), 1e-3);
  for (std::size_t v = 0; v < expected.pixels.size(); ++v)
    if (v % 4 < 3) expected.pixels[v] *= 0.25f;
  EXPECT_LT(largest_difference(draw(part).image, expected), 1e-6);
}

// Occlusion stands for hair in the way where no method does.
TEST(Cards, SurfacesWithoutAMethod_TakeTheirShareAndLeaveOcclusion) {
  Scene open = locks_behind_surfaces(1), part = locks_behind_surfaces(0.25f);
  open.reached = open.past = {};
  part.reached = part.past;
  part.shadowed_by_hair = false;
  Image expected = draw(open).image;
  for (std::size_t v = 0; v < expected.pixels.size(); ++v)
    if (v % 4 < 3) expected.pixels[v] *= 0.25f;
  EXPECT_LT(largest_difference(draw(part).image, expected), 1e-6);
}

TEST(Cards, NumbersThatAreNone_AreRefused) {
  Scene scene{.groom = locks()};
  scene.groom.positions[20].x = std::numeric_limits<float>::quiet_NaN();
  const auto refused = try_draw(scene);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("strand 2: vertex 2"), std::string::npos);
}

}  // namespace
}  // namespace cuticle::render::cards_gpu_test
