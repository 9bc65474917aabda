// What a plate casts on strands, per light, against where its edge lies; what strands cast on it, against rays.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "render/passes/head/head.h"
#include "render/passes/surface_shadow/surface_shadow.h"
#include "render/passes/surface_shadow/surface_shadow_gpu.h"
#include "tests/support/drawn_strands.h"

namespace cuticle::render::surface_shadow_gpu_test {
namespace {

using tests::device, tests::upload;

constexpr std::uint32_t k_vertices = 16;
constexpr double k_bias = 4e-3, k_half_side = 0.1;

/// A level square about the origin, 0.2 m wide.
strands::Mesh plate() {
  const float h = float(k_half_side);
  strands::Mesh mesh;
  mesh.positions = {{-h, 0, -h}, {h, 0, -h}, {h, 0, h}, {-h, 0, h}};
  mesh.normals.assign(4, {0, 1, 0});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Straight strands of 0.15 m at random, `lower` .. `upper` high.
strands::Groom bundle(std::uint32_t count, float lower, float upper, float radius) {
  strands::Groom groom;
  RandomStream random(5);
  const auto number = [&](float least, float most) { return least + (most - least) * float(random.next_unit()); };
  groom.offsets = {0};
  for (std::uint32_t s = 0; s < count; ++s) {
    const glm::vec3 root(number(-0.12f, 0.12f), number(lower, upper), number(-0.12f, 0.12f));
    const glm::vec3 end(number(-0.12f, 0.12f), number(lower, upper), number(-0.12f, 0.12f));
    for (std::uint32_t v = 0; v < k_vertices; ++v) {
      groom.positions.push_back(root + (end - root) * (float(v) / float(k_vertices - 1)));
      groom.radii.push_back(radius);
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  return groom;
}

Light light(const glm::dvec3& to_light) { return {"", glm::normalize(to_light), glm::dvec3(std::numbers::pi)}; }

Light point_light(const glm::dvec3& position) { return {.name = "", .point_light = PointLight{.position = position}}; }
glm::dvec3 to_light_from(const glm::dvec3& point, const Light& light) {
  return light.point_light ? glm::normalize(light.point_light->position - point) : light.to_light;
}

/// The plate, strands and lights in a frame, with what the pass makes of them.
class Frame {
 public:
  Frame(const strands::Groom& groom, const std::vector<Light>& lights, double fibre_alpha, double hair_share = 1,
        int resolution = 1024)
      : plate_(plate()), vertices_(upload(packed(groom))), segments_(upload(firsts(groom))) {
    resources_.edit<Lights>().all = lights;
    resources_.edit<FibreOpacity>().alpha = glm::dvec3(fibre_alpha);
    resources_.edit<Surfaces>().head = &plate_;
    resources_.edit<DrawnHair>().strands = {&vertices_, &segments_, std::uint32_t(groom.vertex_count()),
                                            std::uint32_t(segments_.size() / 4), strands::bounds(groom)};
    resources_.edit<DrawnHair>().casters = resources_.get<DrawnHair>().strands;
    resources_.edit<DrawnHair>().vertices_per_strand = k_vertices;
    for (std::size_t k = 0; k < lights.size(); ++k)
      reached_.push_back(upload(std::vector<float>(groom.vertex_count(), 0.5f)));
    for (const gpu::Buffer& buffer : reached_) resources_.edit<HairTransmittance>().reached.push_back(&buffer);
    resources_.parameters["surface_shadow"] = *registry::parse_assignments(
        surface_shadow::entry().entry.parameters, fmt::format("hair_share={},resolution={}", hair_share, resolution));
    const auto entry = std::ranges::find(gpu_passes(), "surface_shadow", &GpuPassEntry::name);
    pass_ = std::move(*(*entry)->create(device(), resources_));
    pass_->publish(resources_);
  }

  const surface_shadow::Maps& maps() const { return resources_.get<surface_shadow::Maps>(); }

  /// Of each light, where half of it reached the strands before. Once.
  std::vector<std::vector<float>> transmittance() {
    run([](gpu::Commands&) {});
    std::vector<std::vector<float>> all;
    for (const gpu::Buffer& buffer : reached_)
      all.push_back(*gpu::read_buffer<float>(*device(), buffer, resources_.get<DrawnHair>().strands.vertex_count));
    return all;
  }
  std::vector<float> visibility() {
    const std::size_t count = resources_.get<Lights>().all.size() * resources_.get<DrawnHair>().strands.vertex_count;
    return *gpu::read_buffer<float>(*device(), maps().visibility, count);
  }

  /// The plate, white, as a camera 1 m above it sees its middle, 0.16 m wide.
  std::vector<float> picture(int size) {
    const gpu::Texture color = tests::target({size, size}, gpu::TextureFormat::rgba32f),
                       depth = tests::target({size, size}, gpu::TextureFormat::depth32f);
    resources_.edit<FrameView>().camera = {.position = {0, 1, 0},
                                           .target = {0, 0, 0},
                                           .up = {0, 0, -1},
                                           .vertical_field_of_view = 2 * std::atan(0.08),
                                           .near_plane = 0.1,
                                           .far_plane = 10,
                                           .resolution = {size, size}};
    resources_.edit<Targets>().color = resources_.edit<Targets>().resolved = &color;
    resources_.edit<Targets>().depth = &depth;
    resources_.parameters["head"] =
        *registry::parse_assignments(head::entry().entry.parameters, "skin=1/1/1,wrap=0,ambient=0");
    const auto entry = std::ranges::find(gpu_passes(), "head", &GpuPassEntry::name);
    const auto head = std::move(*(*entry)->create(device(), resources_));
    run([&](gpu::Commands& commands) { EXPECT_TRUE(head->record(commands, resources_)); });
    return *device()->download(color);
  }

 private:
  static std::vector<glm::vec4> packed(const strands::Groom& groom) {
    std::vector<glm::vec4> vertices;
    for (std::size_t v = 0; v < groom.vertex_count(); ++v) vertices.emplace_back(groom.positions[v], groom.radii[v]);
    return vertices;
  }
  static std::vector<std::uint32_t> firsts(const strands::Groom& groom) {
    std::vector<std::uint32_t> segments;
    for (std::uint32_t v = 0; v < groom.vertex_count(); ++v)
      if (v % k_vertices + 1 < k_vertices) segments.push_back(v);
    return segments;
  }
  template <class Then>
  void run(Then then) {
    gpu::Commands commands = device()->record();
    EXPECT_TRUE(pass_->record(commands, resources_));
    then(commands);
    const auto cost = device()->submit(std::move(commands));
    EXPECT_TRUE(cost) << (cost ? "" : cost.error().message);
  }

  strands::Mesh plate_;
  gpu::Buffer vertices_, segments_;
  std::vector<gpu::Buffer> reached_;
  Resources resources_;
  std::unique_ptr<GpuPass> pass_;
};

/// How far a point, along the light, is from the plate's plane, and within it from the nearest side; both positive
/// where the plate casts.
struct Place {
  double behind, inside;
};
Place place_of(const glm::dvec3& point, const glm::dvec3& to_light) {
  const double way = -point.y / to_light.y;
  const glm::dvec3 hit = point + way * to_light;
  return {way, k_half_side - std::max(std::abs(hit.x), std::abs(hit.z))};
}

// Five distant lights and two point lights: two rows of maps.
TEST(SurfaceShadow, PlateOverStrands_TakesEachLightOfWhatLiesBehindIt) {
  const strands::Groom groom = bundle(200, -0.1f, 0.1f, 1e-4f);
  const std::vector<Light> lights = {light({0, 1, 0.01}),
                                     light({0.5, 1, 0}),
                                     light({-0.4, 1, 0.6}),
                                     light({0, 0.7, -1}),
                                     light({1, 0.8, 0.3}),
                                     point_light({0.1, 0.5, 0.05}),
                                     point_light({-0.05, 0.25, 0.1})};
  constexpr double k_edge = 1.5e-3;  // texels are up to 0.4 mm wide, seen at up to 60 degrees
  const std::vector<std::vector<float>> reached = Frame(groom, lights, 0.4).transmittance();
  for (std::size_t k = 0; k < lights.size(); ++k) {
    std::size_t dark = 0, bright = 0;
    for (std::size_t v = 0; v < groom.vertex_count(); ++v) {
      const Place place = place_of(groom.positions[v], to_light_from(groom.positions[v], lights[k]));
      if (std::min(std::abs(place.inside), std::abs(place.behind - k_bias)) < k_edge) continue;
      const bool is_dark = place.behind > k_bias && place.inside > 0;
      (is_dark ? dark : bright) += 1;
      ASSERT_EQ(reached[k][v], is_dark ? 0.0f : 0.5f) << "light " << k << ", vertex " << v;
    }
    EXPECT_GT(std::min(dark, bright), 400u);
  }
}

TEST(SurfaceShadow, EdgeOfAPlate_FadesOverTheFilter) {
  // Vertices across an edge, 0.05 m below it, closer together than texels.
  strands::Groom groom;
  groom.offsets = {0, k_vertices};
  for (std::uint32_t v = 0; v < k_vertices; ++v)
    groom.positions.push_back({float(k_half_side) + 1e-4f * (float(v) - 7.5f), -0.05f, 0});
  groom.radii.assign(k_vertices, 1e-5f);
  Frame frame(groom, {light({0, 1, 0})}, 0.4);
  const std::vector<float> reached = frame.transmittance()[0];
  EXPECT_EQ(reached.front(), 0.0f);
  EXPECT_EQ(reached.back(), 0.5f);
  // From 0 to .5 over two texels, .2 / 1020 m each: .128 from one vertex to the next.
  for (std::size_t v = 1; v < reached.size(); ++v) {
    EXPECT_GE(reached[v], reached[v - 1]);
    EXPECT_LT(reached[v], reached[v - 1] + 0.13f);
  }
  const std::vector<float> visibility = frame.visibility();
  for (std::size_t v = 0; v < reached.size(); ++v) EXPECT_EQ(reached[v], 0.5f * visibility[v]);
}

struct Share {
  double share, most_error;
  int resolution = 1024;
};
class HairShare : public testing::TestWithParam<Share> {};

TEST_P(HairShare, StrandsOverAPlate_CastAsMuchAsRaysFind) {
  const strands::Groom groom = bundle(400, 0.02f, 0.1f, 4e-4f);
  const Light point_light = light({0.3, 1, 0.2});
  constexpr int k_size = 32, k_block = 8;
  constexpr double k_alpha = 0.5;
  const std::vector<float> picture =
      Frame(groom, {point_light}, k_alpha, GetParam().share, GetParam().resolution).picture(k_size);
  std::vector<glm::vec3> points;
  for (int y = 0; y < k_size; ++y)
    for (int x = 0; x < k_size; ++x)
      points.emplace_back(0.16f * ((float(x) + 0.5f) / k_size - 0.5f), 0, 0.16f * ((float(y) + 0.5f) / k_size - 0.5f));
  const shadows::Method& truth = **shadows::find_method("truth");
  const auto reached = truth.evaluate({&groom, k_alpha, point_light.to_light}, {points, {}},
                                      registry::default_values(truth.entry.parameters));
  ASSERT_TRUE(reached) << reached.error().message;
  double error = 0, bias = 0, shadow = 0;
  constexpr int k_blocks = k_size / k_block;
  for (int block = 0; block < k_blocks * k_blocks; ++block) {
    double drawn = 0, expected = 0;
    for (int k = 0; k < k_block * k_block; ++k) {
      const int x = block % k_blocks * k_block + k % k_block, y = block / k_blocks * k_block + k / k_block;
      drawn += double(picture[std::size_t(4 * (y * k_size + x))]) / point_light.to_light.y;
      expected += double(reached->values[std::size_t(y * k_size + x)]);
    }
    error += std::abs(drawn - expected) / (k_block * k_block);
    bias += (drawn - expected) / (k_block * k_block);
    shadow += 1 - expected / (k_block * k_block);
  }
  std::printf("mean shadow %.4f, mean error of 8 x 8 pixels %.4f, bias %+.4f\n", shadow / (k_blocks * k_blocks),
              error / (k_blocks * k_blocks), bias / (k_blocks * k_blocks));
  EXPECT_GT(shadow / (k_blocks * k_blocks), 0.3);
  EXPECT_LT(error / (k_blocks * k_blocks), GetParam().most_error);
  EXPECT_NEAR(bias / (k_blocks * k_blocks), 0, 0.03);
}

// Of all, and of a quarter that is four times as wide: 100 strands leave .059 of grain. Maps of 4096 x 4096 are drawn
// in two bands where a binding holds 128 MiB; the filter is of texels, which are smaller, and leaves
// .030.
INSTANTIATE_TEST_SUITE_P(Shares, HairShare, testing::Values(Share{1, 0.03}, Share{0.25, 0.08}, Share{1, 0.04, 4096}));

TEST(SurfaceShadow, BandsOfAnyMaps_AreNoLargerThanABinding) {
  constexpr std::uint64_t k_binding = 134217728;
  EXPECT_EQ(surface_shadow::hair_bands(1024, 8, k_binding), 1u) << "the default, with as many lights as there may be";
  EXPECT_EQ(surface_shadow::hair_bands(4096, 1, k_binding), 2u);
  for (int resolution : {16, 100, 1024, 3001, 4096})
    for (int lights = 1; lights <= int(k_max_lights); ++lights) {
      const glm::ivec2 size = surface_shadow::texture_size(resolution, lights);
      const std::uint64_t bands = surface_shadow::hair_bands(resolution, lights, k_binding),
                          parts = (3 * std::uint64_t(size.y) + surface_shadow::k_rows_of_a_part - 1) /
                                  surface_shadow::k_rows_of_a_part;
      EXPECT_LE((parts + bands - 1) / bands * surface_shadow::k_rows_of_a_part * std::uint64_t(size.x) * 4, k_binding)
          << resolution << ", " << lights;
    }
}

}  // namespace
}  // namespace cuticle::render::surface_shadow_gpu_test
