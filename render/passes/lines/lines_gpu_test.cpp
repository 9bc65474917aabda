// A wide straight strand in the middle of the picture: its pixel is S x irradiance x transmittance, with S
// from the model itself in double, from the angles; the pass has half-float tables and dot products.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "gpu/tests/test_device.h"
#include "lut/bake_gpu.h"
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/lines/lines.h"
#include "strands/lod/lod.h"
#include "strands/lod/spread_order.h"

namespace cuticle::render::lines_gpu_test {
namespace {

constexpr int k_size = 17;  // odd: the middle pixel looks along the camera's axis
const glm::dvec3 k_eye(0, 0, 1);

using tests::device;

const bsdf::Model& model() { return **bsdf::find_model("marschner"); }
registry::ParameterValues material(std::string_view text) {
  return *registry::parse_assignments(model().entry.parameters, text);
}
constexpr std::string_view k_material = "sigma_a=0.2/0.4/0.8,beta=0.25,alpha=-0.1";
const lut::Layout& layout() { return **lut::find_layout("nalu"); }

const lut::TableSet& tables() {
  static const lut::TableSet set = *lut::bake(model(), material(k_material), layout(), 128, silent_progress());
  return set;
}

std::unique_ptr<GpuPass> make_pass(const Resources& resources) {
  const auto entry = std::ranges::find(gpu_passes(), "lines", &GpuPassEntry::name);
  auto pass = (*entry)->create(device(), resources);
  EXPECT_TRUE(pass) << (pass ? "" : pass.error().message);
  return std::move(*pass);
}

/// The picture, four floats a pixel.
std::vector<float> drawn(GpuPass& pass, const Resources& resources) {
  gpu::Commands commands = device()->record();
  EXPECT_TRUE(pass.record(commands, resources));
  const auto cost = device()->submit(std::move(commands));
  EXPECT_TRUE(cost) << (cost ? "" : cost.error().message);
  return *device()->download(*resources.get<Targets>().color);
}

/// A target of so many pixels square, one sample each.
gpu::Texture target(int size, gpu::TextureFormat format) {
  return std::move(*device()->make_texture({{size, size}, format, gpu::Filter::nearest, 1, true}));
}

/// One strand of two vertices through the origin, drawn alone.
struct OneStrand {
  glm::dvec3 tangent;
  std::vector<Light> lights;
  std::vector<float> reached;  ///< transmittance per light
  double ambient = 0;
  bool packed = false;
  double end = 0.3, end_radius = 1e-4;  ///< of the strand, along its tangent

  glm::vec4 center_pixel() const {
    const std::vector<gpu::Texture> textures = *lut::upload(*device(), tables());
    const auto vertices = upload<glm::vec4>({{-0.3 * tangent, 1e-4}, {end * tangent, end_radius}});
    const auto tangents = upload<glm::vec4>({{tangent, 0}, {tangent, 1}});
    const auto segments = upload<std::uint32_t>({0});
    std::vector<gpu::Buffer> transmittance;
    for (float value : reached) transmittance.push_back(upload<float>({value, value}));
    const gpu::Texture color = target(k_size, gpu::TextureFormat::rgba32f),
                       depth = target(k_size, gpu::TextureFormat::depth32f);

    Resources resources;
    resources.edit<FrameView>().camera = {
        .position = k_eye, .vertical_field_of_view = 0.3, .resolution = {k_size, k_size}};
    resources.edit<Lights>().all = lights;
    resources.edit<DrawnHair>().strands = {&vertices, &segments, 2, 1, {}};
    resources.edit<DrawnHair>().tangents = &tangents;
    for (const gpu::Buffer& buffer : transmittance) resources.edit<HairTransmittance>().reached.push_back(&buffer);
    resources.edit<DrawnHair>().vertices_per_strand = 2;
    resources.edit<Targets>().color = resources.edit<Targets>().resolved = &color;
    resources.edit<Targets>().depth = &depth;
    resources.edit<Targets>().supersampling = 1;
    resources.parameters["lines"] = parameters();
    resources.edit<bake_tables::Tables>().set = &tables();
    for (const gpu::Texture& texture : textures) resources.edit<bake_tables::Tables>().textures.push_back(&texture);
    return draw(*make_pass(resources), resources);
  }

 private:
  registry::ParameterValues parameters() const {
    registry::ParameterValues values = registry::default_values(lines::entry().entry.parameters);
    values.set("width_px", 8.0);
    values.set("variation", 0.0);
    values.set("tip_variation", 0.0);
    values.set("ambient", ambient);
    values.set("packed", packed);
    return values;
  }

  template <class T>
  static gpu::Buffer upload(std::vector<T> data) {
    return std::move(*gpu::make_buffer_from<T>(*device(), data));
  }

  static glm::vec4 draw(GpuPass& pass, const Resources& resources) {
    const std::vector<float> pixels = drawn(pass, resources);
    const float* pixel = pixels.data() + 4 * (k_size / 2 * k_size + k_size / 2);
    return {pixel[0], pixel[1], pixel[2], pixel[3]};
  }
};

/// The model's S for directions, by angles: inclinations by asin, azimuths by atan2.
glm::dvec3 exact_radiance(const glm::dvec3& t, const Light& light) {
  const auto azimuth = [&](const glm::dvec3& w) {
    const glm::dvec3 side = glm::normalize(glm::cross(t, glm::dvec3(0.3, 0.5, 0.81))), other = glm::cross(t, side);
    return std::atan2(glm::dot(w, other), glm::dot(w, side));
  };
  const glm::dvec3 to_eye = glm::normalize(k_eye);
  bsdf::Point point;
  point.theta_i = std::asin(glm::dot(light.to_light, t));
  point.theta_o = std::asin(glm::dot(to_eye, t));
  point.phi = std::remainder(azimuth(to_eye) - azimuth(light.to_light), 2 * std::numbers::pi);
  glm::dvec3 scattered{0};
  EXPECT_TRUE(
      bsdf::evaluate(*tables().model, tables().values, bsdf::Precision::f64, {.points = {&point, 1}}, {&scattered, 1}));
  return scattered * light.irradiance;
}

Light light_from(double x, double y, double z) {
  return {.name = "", .to_light = glm::normalize(glm::dvec3(x, y, z)), .irradiance = {1, 2, 3}};
}

/// Worst channel error, relative to the brightest channel; radiance below k_dim is not told apart from 0.
double error(const glm::vec4& pixel, const glm::dvec3& exact) {
  constexpr double k_dim = 1e-3;
  const glm::dvec3 apart = glm::abs(glm::dvec3(pixel) - exact);
  return std::max({apart.x, apart.y, apart.z}) / std::max({exact.x, exact.y, exact.z, k_dim});
}

// A point light's light at the strand: 1 / distance^2 of its intensity, of which a spot's ramp leaves ((cos 20 - cos
// 40) / (cos 10 - cos 40))^2 to what lies 20 degrees beside its axis.
TEST(Lines, PixelByAPointLight_IsThatByItsLightThere) {
  const double degree = std::numbers::pi / 180, distance = 0.4;
  const glm::dvec3 to_light = glm::normalize(glm::dvec3(0.3, 0.05, 1)),
                   beside = glm::normalize(glm::cross(to_light, glm::dvec3(0, 1, 0)));
  const double ramp = (std::cos(20 * degree) - std::cos(40 * degree)) / (std::cos(10 * degree) - std::cos(40 * degree));
  for (const bool is_spot : {false, true}) {
    Light point_light{.name = "", .point_light = PointLight{.position = distance * to_light, .intensity = {1, 2, 3}}};
    if (is_spot) {
      point_light.point_light->axis = -std::cos(20 * degree) * to_light + std::sin(20 * degree) * beside;
      point_light.point_light->inner_angle = 10 * degree;
      point_light.point_light->outer_angle = 40 * degree;
    }
    const Light there{.name = "",
                      .to_light = to_light,
                      .irradiance = glm::dvec3(1, 2, 3) * ((is_spot ? ramp * ramp : 1) / (distance * distance))};
    const glm::vec4 by_point_light = OneStrand{{0, 1, 0}, {point_light}, {0.5f}}.center_pixel(),
                    by_distant = OneStrand{{0, 1, 0}, {there}, {0.5f}}.center_pixel();
    ASSERT_GT(by_distant.x, 0.01f);
    EXPECT_LT(error(by_point_light, glm::dvec3(by_distant)), 1e-3) << is_spot;
  }
}

// Measured worst over these directions: see README.md.
TEST(Lines, PixelOfAStrand_EqualsTheModel) {
  double worst = 0;
  for (const glm::dvec3& axis :
       {glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0.6, 0.8, 0), glm::dvec3(0.5, 0.7, 0.5)})
    for (const Light& light :
         {light_from(0, 0.2, 1), light_from(1, 0.5, 0.6), light_from(-0.7, 0.8, 0.2), light_from(0.3, 0.4, -1)}) {
      const OneStrand strand{glm::normalize(axis), {light}, {1}};
      const glm::dvec3 exact = exact_radiance(strand.tangent, light);
      worst = std::max(worst, error(strand.center_pixel(), exact));
    }
  RecordProperty("worst_relative_error", std::to_string(worst));
  EXPECT_LT(worst, 0.05) << worst;
}

// The tangent's error of 4.9e-5 moves the sharpest lobe by far less than the tables' own error.
TEST(Lines, PackedStrand_IsDrawnAsTheFullOne) {
  double worst = 0;
  for (const glm::dvec3& axis : {glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0.8, 0), glm::dvec3(0.5, 0.7, 0.5)}) {
    OneStrand strand{glm::normalize(axis), {light_from(1, 0.5, 0.6)}, {0.7f}, 0.6};
    const glm::vec4 full = strand.center_pixel();
    strand.packed = true;
    worst = std::max(worst, error(strand.center_pixel(), glm::dvec3(full)));
  }
  RecordProperty("worst_relative_error", std::to_string(worst));
  EXPECT_LT(worst, 1e-3) << worst;
}

/// Upright strands side by side, in an order of which each prefix is spread over them; seen from a distance, unlit.
class Fence {
 public:
  static constexpr int k_strands = 64, k_vertices = 16, k_pixels = 512;
  static constexpr strands::Bounds k_bounds{{-0.63f, -0.45f, 0}, {0.63f, 0.45f, 0}};

  static Camera camera_at(double distance) {
    return {.position = {0, 0, distance}, .vertical_field_of_view = 0.8, .resolution = {k_pixels, k_pixels}};
  }

  explicit Fence(double full_px) {
    std::vector<glm::vec4> vertices, tangents;
    std::vector<strands::StrandShape> places(k_strands);
    for (int k = 0; k < k_strands; ++k) places[std::size_t(k)].fill({float(k), 0, 0});
    for (std::uint32_t place : strands::spread_order(places))
      for (int i = 0; i < k_vertices; ++i) {
        vertices.emplace_back(0.02f * (float(place) - 31.5f), 0.06f * float(i) - 0.45f, 0, 1e-4f);
        tangents.emplace_back(0, 1, 0, float(i) / 15);
      }
    vertices_ = *gpu::make_buffer_from<glm::vec4>(*device(), vertices);
    tangents_ = *gpu::make_buffer_from<glm::vec4>(*device(), tangents);
    parameters_ = registry::default_values(lines::entry().entry.parameters);
    parameters_.set("full_px", full_px);
    parameters_.set("width_px", 1.0);
    parameters_.set("tip_variation", 0.0);
  }

  /// Share of the picture that is covered.
  double covered(double distance) const {
    const gpu::Texture color = target(k_pixels, gpu::TextureFormat::rgba32f),
                       depth = target(k_pixels, gpu::TextureFormat::depth32f);
    Resources resources;
    resources.edit<FrameView>().camera = camera_at(distance);
    constexpr std::uint32_t count = k_strands * k_vertices;
    resources.edit<DrawnHair>().strands = {&vertices_, nullptr, count, 0, k_bounds};
    resources.edit<DrawnHair>().tangents = &tangents_;
    resources.edit<DrawnHair>().vertices_per_strand = k_vertices;
    resources.edit<Targets>().color = resources.edit<Targets>().resolved = &color;
    resources.edit<Targets>().depth = &depth;
    resources.edit<Targets>().supersampling = 1;
    resources.parameters["lines"] = parameters_;
    const std::vector<float> pixels = drawn(*make_pass(resources), resources);
    double sum = 0;
    for (std::size_t i = 3; i < pixels.size(); i += 4) sum += double(pixels[i]);
    return sum / (k_pixels * k_pixels);
  }

 private:
  gpu::Buffer vertices_, tangents_;
  registry::ParameterValues parameters_;
};

// At 3 m the fence covers a quarter of what it covers at 1.5 m: 16 strands four pixels wide for 64 of one.
TEST(Lines, LevelOfDetail_DrawsAPrefixThatCoversTheSameArea) {
  const double full_px = strands::covered_pixels(Fence::k_bounds, Fence::camera_at(1.5));
  const double near = Fence(0).covered(1.5);
  EXPECT_NEAR(Fence(full_px).covered(1.5), near, 1e-9) << "all strands where the hair covers full_px";
  const double far = Fence(0).covered(3), prefix = Fence(full_px).covered(3);
  RecordProperty("area_over_that_of_all", std::to_string(prefix / far));
  EXPECT_GT(far, 0);
  EXPECT_NEAR(prefix / far, 1, 0.02);
}

TEST(Lines, TwoLights_AddUpUnderTheirTransmittance) {
  const glm::dvec3 axis(0, 1, 0);
  const Light first = light_from(0, 0.2, 1), second = light_from(1, 0.5, 0.6);
  const glm::vec4 a = OneStrand{axis, {first}, {1}}.center_pixel(), b = OneStrand{axis, {second}, {1}}.center_pixel();
  const glm::vec4 both = OneStrand{axis, {first, second}, {0.25f, 0.5f}}.center_pixel();
  EXPECT_GT(both.x, 1e-3f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(both[c], 0.25f * a[c] + 0.5f * b[c], 1e-5f * both[c]);
}

TEST(Lines, LightAlongTheFibre_IsFinite) {
  const glm::vec4 pixel = OneStrand{{0, 1, 0}, {light_from(0, 1, 0)}, {1}, 1}.center_pixel();
  for (int c = 0; c < 4; ++c) EXPECT_TRUE(std::isfinite(pixel[c]));
}

TEST(Lines, EndThatIsNoNumber_LeavesTheSegmentOut) {
  const double nan = std::nan(""), infinite_in_float = 1e39;
  const auto pixel = [](double end, double radius) {
    return OneStrand{.tangent = {0, 1, 0}, .lights = {}, .reached = {}, .end = end, .end_radius = radius}
        .center_pixel();
  };
  EXPECT_EQ(pixel(0.3, 1e-4), glm::vec4(0, 0, 0, 1));
  for (double none : {nan, infinite_in_float}) {
    EXPECT_EQ(pixel(none, 1e-4), glm::vec4(0)) << none;
    EXPECT_EQ(pixel(0.3, none), glm::vec4(0)) << none;
  }
}

TEST(Lines, NoLight_IsBlackButCovers) {
  EXPECT_EQ((OneStrand{{0, 1, 0}, {}, {}, 1}.center_pixel()), glm::vec4(0, 0, 0, 1));
}

}  // namespace
}  // namespace cuticle::render::lines_gpu_test
