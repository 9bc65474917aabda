// Shading points: how many there are near and far, that what is not seen has none, and how far interpolation is off.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "bsdf/dual_scattering/corrections.h"
#include "bsdf/dual_scattering/dual_scattering.h"
#include "lut/bake_gpu.h"
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/dual_scattering/dual_scattering.h"
#include "render/passes/lines/lines.h"
#include "render/passes/shade_strands/shade_strands_gpu.h"
#include "render/passes/surface_shadow/surface_shadow_gpu.h"
#include "render/passes/tile_lists/tile_lists_gpu.h"
#include "strands/thickness.h"
#include "tests/support/drawn_strands.h"

namespace cuticle::render::shade_strands_gpu_test {
namespace {

using tests::device, tests::upload;

constexpr std::uint32_t k_strands = 40, k_vertices = 33;
constexpr double k_field_of_view = 0.5;
constexpr int k_size = 256;

constexpr const char* k_blond = "sigma_a=0.1/0.2/0.4,beta=0.2";
const glm::dvec3 k_to_light = glm::normalize(glm::dvec3(0.4, 0.5, 1));
constexpr double k_irradiance = 3, k_density = 0.7;

const bsdf::Model& model() { return **bsdf::find_model("marschner"); }
registry::ParameterValues material(const std::string& text) {
  return *registry::parse_assignments(model().entry.parameters, text);
}

/// What is drawn, and how.
struct Settings {
  double distance = 1, point_px = 0, lower = 0;
  bool dual = false;
  float transmittance = 1;  ///< hair's transmittance of every vertex
  float past = 1;           ///< what surfaces leave
  double spread = 0;        ///< of the fibres' directions, for dual scattering
  const char* material = k_blond;
  const strands::Groom* at_rest = nullptr;  ///< for the corrections of dual scattering; null: none
  const strands::Mesh* head = nullptr;
};

struct Shaded {
  std::vector<std::uint32_t> vertices;  ///< that were shaded, ascending
  std::vector<glm::vec4> colors;        ///< of all
};

/// Wavy strands, 0.3 m long, side by side at x = -0.1 .. 0.1 and, for `aside`, half of them far outside the view.
class Field {
 public:
  explicit Field(bool aside = false) {
    for (std::uint32_t s = 0; s < k_strands; ++s)
      for (std::uint32_t v = 0; v < k_vertices; ++v) {
        const float t = float(v) / (k_vertices - 1), swing = 9 * t + float(s);
        const float x = 0.2f * (float(s) / k_strands - 0.5f) + (aside && s % 2 == 1 ? 50.0f : 0.0f);
        points_.emplace_back(x + 0.01f * std::sin(swing), 0.15f - 0.3f * t, 0.01f * std::cos(swing), 5e-4f);
        if (v + 1 < k_vertices) segments_.push_back(s * k_vertices + v);
      }
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const bool tip = k % k_vertices == k_vertices - 1;
      const glm::vec3 along(tip ? points_[k] - points_[k - 1] : points_[k + 1] - points_[k]);
      tangents_.emplace_back(glm::normalize(along), float(k % k_vertices) / (k_vertices - 1));
    }
  }

  const glm::vec4& point(std::size_t vertex) const { return points_[vertex]; }
  const glm::vec4& tangent(std::size_t vertex) const { return tangents_[vertex]; }

  Shaded shade(const Settings& settings) const {
    const gpu::Buffer vertices = upload(points_), segments = upload(segments_), tangents = upload(tangents_),
                      reached = upload(std::vector<float>(points_.size(), settings.transmittance * settings.past));
    surface_shadow::Maps maps;
    maps.visibility = upload(std::vector<float>(points_.size(), settings.past));
    const lut::TableSet set =
        *lut::bake(model(), material(settings.material), **lut::find_layout("nalu"), 32, silent_progress());
    const std::vector<gpu::Texture> textures = *lut::upload(*device(), set);
    const gpu::Texture depth = tests::target({k_size, k_size}, gpu::TextureFormat::depth32f);
    Resources resources;
    resources.edit<FrameView>().camera = {.position = {0, settings.lower, settings.distance},
                                          .target = {0, settings.lower, 0},
                                          .vertical_field_of_view = k_field_of_view,
                                          .near_plane = 0.1,
                                          .far_plane = 1000,
                                          .resolution = {k_size, k_size}};
    resources.edit<Lights>().all.push_back({"", k_to_light, glm::dvec3(k_irradiance)});
    resources.edit<HairTransmittance>().reached = {&reached};
    if (settings.past < 1) resources.put_reference(maps);
    if (settings.at_rest) resources.put(RestStrands{settings.at_rest});
    if (settings.at_rest) resources.edit<FibreOpacity>().alpha = glm::dvec3(1);
    if (settings.head) resources.edit<Surfaces>().head = settings.head;
    resources.edit<DrawnHair>().strands = {
        &vertices, &segments, std::uint32_t(points_.size()), std::uint32_t(segments_.size()), {}};
    resources.edit<DrawnHair>().tangents = &tangents;
    resources.edit<bake_tables::Tables>().set = &set;
    for (const gpu::Texture& texture : textures) resources.edit<bake_tables::Tables>().textures.push_back(&texture);
    resources.edit<DrawnHair>().vertices_per_strand = k_vertices;
    resources.edit<Targets>().depth = &depth;
    resources.edit<Targets>().supersampling = 1;
    auto values = registry::default_values(shade_strands::entry().entry.parameters);
    values.set("point_px", settings.point_px);
    resources.parameters["shade_strands"] = values;
    auto shared = registry::default_values(lines::entry().entry.parameters);
    for (std::string_view name : {"tip_variation", "variation", "ambient"}) shared.set(name, 0.0);
    resources.parameters["lines"] = shared;
    auto dual = registry::default_values(dual_scattering::entry().entry.parameters);
    for (std::string_view name : {"forward_density", "backward_density"}) dual.set(name, k_density);
    dual.set("direction_spread", settings.spread);
    resources.parameters["dual_scattering"] = dual;
    return run(resources, settings.dual);
  }

 private:
  static Shaded run(Resources& resources, bool dual) {
    std::vector<std::unique_ptr<GpuPass>> passes;
    for (std::string_view name : {"tile_lists", "dual_scattering", "shade_strands"}) {
      if (name == "dual_scattering" && !dual) continue;
      const auto entry = std::ranges::find(gpu_passes(), name, &GpuPassEntry::name);
      passes.push_back(std::move(*(*entry)->create(device(), resources)));
      passes.back()->publish(resources);
    }
    gpu::Commands commands = device()->record();
    commands.fill(*resources.get<shade_strands::StrandColors>().values, 0);
    for (const auto& pass : passes) EXPECT_TRUE(pass->record(commands, resources));
    EXPECT_TRUE(device()->submit(std::move(commands)));
    Shaded shaded;
    if (const gpu::Buffer* const list_buffer = resources.get<shade_strands::StrandColors>().shaded_vertices) {
      const gpu::Buffer& list = *list_buffer;
      const auto words = *gpu::read_buffer<std::uint32_t>(*device(), list, list.size() / 4);
      shaded.vertices.assign(words.begin() + 4, words.begin() + 4 + words[0]);
      std::ranges::sort(shaded.vertices);
    }
    const std::uint32_t count = resources.get<DrawnHair>().strands.vertex_count;
    const auto halves =
        *gpu::read_buffer<std::uint64_t>(*device(), *resources.get<shade_strands::StrandColors>().values, count);
    for (std::uint64_t half : halves) shaded.colors.push_back(glm::unpackHalf4x16(half));
    return shaded;
  }

  std::vector<glm::vec4> points_, tangents_;
  std::vector<std::uint32_t> segments_;
};

// A strand is a helix, 0.313 m along the fibre.
TEST(ShadeStrands, FarStrands_HaveFewerPoints) {
  const Field field;
  std::size_t last = k_strands * k_vertices + 1;
  for (double distance : {2.0, 4.0, 16.0, 64.0}) {
    const double pixels = 0.313 / distance * k_size / (2 * std::tan(k_field_of_view / 2));
    const double expected = std::clamp(1 + std::ceil(pixels / 4), 2.0, double(k_vertices));
    const std::size_t shaded = field.shade({.distance = distance, .point_px = 4}).vertices.size();
    std::printf("%g m: %.2f points a strand\n", distance, double(shaded) / k_strands);
    EXPECT_NEAR(double(shaded) / k_strands, expected, 0.6) << distance;
    EXPECT_LT(shaded, last);
    last = shaded;
  }
  EXPECT_EQ(last, 2 * k_strands);
}

TEST(ShadeStrands, StrandsOutOfView_HaveNone) {
  const Shaded half = Field(true).shade({.distance = 4, .point_px = 4});
  Shaded all = Field().shade({.distance = 4, .point_px = 4});
  EXPECT_GT(half.vertices.size(), 0u);
  for (std::uint32_t vertex : half.vertices) EXPECT_EQ(vertex / k_vertices % 2, 0u);
  std::erase_if(all.vertices, [](std::uint32_t vertex) { return vertex / k_vertices % 2 == 1; });
  EXPECT_EQ(half.vertices, all.vertices);
}

// The camera sees the lower part of all strands.
TEST(ShadeStrands, StrandsHalfInView_HavePointsThereAndOneBefore) {
  const Field field;
  const Shaded whole = field.shade({.point_px = 4}), part = field.shade({.point_px = 4, .lower = -0.24});
  EXPECT_LT(part.vertices.size(), whole.vertices.size());
  EXPECT_TRUE(std::ranges::all_of(part.vertices, [](std::uint32_t vertex) { return vertex % k_vertices > 5; }));
}

// Measured: .04 and .075 of the mean brightness; the strands turn about themselves 1.4 times.
TEST(ShadeStrands, VerticesBetweenPoints_AreNearTheirOwnShading) {
  const Field field;
  const Shaded full = field.shade({});
  double last = 0;
  for (double point_px : {1.0, 8.0, 12.0}) {
    const Shaded shaded = field.shade({.point_px = point_px});
    double off = 0, all = 0;
    for (std::size_t k = 0; k < full.colors.size(); ++k) {
      off += double(glm::distance(shaded.colors[k], full.colors[k]));
      all += double(glm::length(glm::vec3(full.colors[k])));
    }
    for (std::uint32_t vertex : shaded.vertices) EXPECT_EQ(shaded.colors[vertex], full.colors[vertex]);
    std::printf("a point each %g px: %zu of %zu vertices, error %.4f\n", point_px, shaded.vertices.size(),
                full.colors.size(), off / all);
    EXPECT_EQ(off == 0, point_px == 1);
    EXPECT_GE(off, last);
    last = off;
    EXPECT_LT(off / all, 0.12);
  }
}

using ByChannel = std::array<bsdf::dual_scattering::Corrections, 3>;

/// Those of one point: of its depth times those of its angle.
bsdf::dual_scattering::Correction correction_at(const bsdf::dual_scattering::Corrections& corrections,
                                                double transmittance, double toward) {
  const auto depth = bsdf::dual_scattering::between_depths(transmittance),
             angle = bsdf::dual_scattering::between_angles(toward);
  const auto between = [&](double bsdf::dual_scattering::Correction::*factor) {
    const auto at = [&](const auto& rows, const bsdf::dual_scattering::Between& place) {
      const auto row = std::size_t(place.below);
      return std::lerp(rows[row].*factor, rows[row + 1].*factor, place.share);
    };
    return at(corrections.depths, depth) * at(corrections.angles, angle);
  };
  return {between(&bsdf::dual_scattering::Correction::onward), between(&bsdf::dual_scattering::Correction::back),
          between(&bsdf::dual_scattering::Correction::diffuse)};
}

/// By dual scattering where a fifth of the light arrives; its terms take seconds.
const Shaded& deep_in_hair() {
  static const Shaded shaded = Field().shade({.dual = true, .transmittance = 0.2f});
  return shaded;
}

double brightness(const Shaded& shaded) {
  double sum = 0;
  for (const glm::vec4& color : shaded.colors) sum += double(color.x + color.y + color.z);
  return sum;
}

/// Dual scattering in double, from the averages at the very angles: beside the direct S, radiance per irradiance.
glm::dvec3 dual_scattering_at(const glm::dvec3& t, const glm::dvec3& to_eye, double transmittance, double spread,
                              const ByChannel& corrections = {}) {
  const registry::ParameterValues values = material(k_blond);
  const double theta_i = std::asin(glm::dot(k_to_light, t)), theta_o = std::asin(glm::dot(to_eye, t)),
               theta_d = (theta_o - theta_i) / 2, pi = std::numbers::pi;
  const glm::dvec3 across_i = k_to_light - std::sin(theta_i) * t, across_o = to_eye - std::sin(theta_o) * t;
  const double phi = std::acos(glm::dot(glm::normalize(across_i), glm::normalize(across_o)));
  const bsdf::AverageScattering path = *bsdf::average_scattering(model(), values, theta_i),
                                local = *bsdf::average_scattering(model(), values, theta_d);
  const bsdf::MultipleBackscattering multiple = *bsdf::multiple_backscattering(local);
  const double met = std::log(1 / transmittance);
  glm::dvec3 result;
  for (int c = 0; c < 3; ++c) {
    const double sent = std::pow(transmittance, 1 - path.forward.share[c]) - transmittance,
                 // Scatterings of light that is scattered at least once: of a Poisson number.
        mean = met * path.forward.share[c], events = mean / (1 - std::exp(-mean)),
                 wider = events * (path.forward.deviation[c] * path.forward.deviation[c] + spread * spread);
    const auto lobe = [&](double share, double shift, double deviation, double more) {
      const double variance = deviation * deviation + more, off = theta_i + theta_o - shift;
      return share * std::exp(-off * off / (2 * variance)) / std::sqrt(2 * pi * variance);
    };
    const double once =
        lobe(local.forward.share[c], local.forward.shift[c], local.forward.deviation[c], wider) * phi / pi +
        lobe(local.backward.share[c], local.backward.shift[c], local.backward.deviation[c], wider) * (1 - phi / pi);
    const auto back = [&](double more) {
      return k_density * (1 - phi / pi) *
             lobe(multiple.attenuation[c], multiple.shift[c], multiple.deviation[c], more + spread * spread);
    };
    const bsdf::dual_scattering::Correction correction =
        correction_at(corrections[std::size_t(c)], transmittance, glm::dot(k_to_light, to_eye));
    result[c] = (correction.back * (transmittance * back(0) + k_density * sent * back(wider)) +
                 correction.onward * k_density * sent * once) *
                    std::cos(theta_i) / (pi * std::cos(theta_d) * std::cos(theta_d)) +
                k_density * correction.diffuse / (4 * pi);
  }
  return result;
}

// Measured: off by 1 % of the brightest where nearly all light is direct (halves hold the sum), .13 % where little is;
// blond hair is 1.3 and 3.4 times as bright, black hair 1.05.
TEST(ShadeStrands, DualScattering_IsThatOfTheAveragesAtEachPoint) {
  const Field field;
  double gain = 0;
  for (const auto& [transmittance, spread] : {std::pair{0.9f, 0.0}, {0.2f, 0.4}, {0.2f, 0.0}}) {
    const Shaded with = transmittance == 0.2f && spread == 0
                            ? deep_in_hair()
                            : field.shade({.dual = true, .transmittance = transmittance, .spread = spread}),
                 without = field.shade({.transmittance = transmittance});
    double worst = 0, brightest = 0;
    for (std::size_t k = 5; k < with.colors.size(); k += 311) {
      const glm::dvec3 to_eye = glm::normalize(glm::dvec3(0, 0, 1) - glm::dvec3(field.point(k)));
      const glm::dvec3 exact =
          k_irradiance * dual_scattering_at(glm::dvec3(field.tangent(k)), to_eye, double(transmittance), spread);
      const glm::dvec3 more = glm::dvec3(with.colors[k]) - glm::dvec3(without.colors[k]);
      for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(more[c] - exact[c]));
        brightest = std::max(brightest, exact[c]);
      }
    }
    gain = brightness(with) / brightness(without);
    std::printf("transmittance %g, directions %g: off by %.5f of %.5f, %.3f times as bright\n", double(transmittance),
                spread, worst, brightest, gain);
    EXPECT_LT(worst, 0.015 * brightest);
  }
  EXPECT_GT(gain, 2) << "blond, where a fifth of the light arrives directly";
}

/// Straight hairs behind each other, which a ray meets as dense hair.
strands::Groom dense_hair() {
  strands::Groom hair;
  for (int s = 0; s < 2000; ++s) {
    const float x = 0.01f * float(s % 40), z = 0.01f * float(s / 40);
    for (const float y : {0.f, 0.1f}) hair.positions.emplace_back(x, y, z), hair.radii.push_back(4e-4f);
    hair.offsets.push_back(std::uint32_t(hair.positions.size()));
  }
  return hair;
}

// Of hair alone and of hair on a head; measured: off by at most .5 % of the brightest.
TEST(ShadeStrands, DualScatteringWithStrandsAtRest_IsCorrectedByDepthAngleAndHead) {
  using bsdf::dual_scattering::Within;
  const Field field;
  const strands::Groom hair = dense_hair();
  const strands::Mesh head;
  const bsdf::AverageScattering average = *bsdf::average_scattering(model(), material(k_blond), 0);
  const Shaded without = field.shade({.transmittance = 0.2f});
  for (const Within within : {Within::hair_alone, Within::hair_on_head}) {
    ByChannel corrections;
    for (int c = 0; c < 3; ++c)
      corrections[std::size_t(c)] = bsdf::dual_scattering::corrections_of(
          bsdf::dual_scattering::fitted_corrections(within), average.forward.share[c] + average.backward.share[c],
          strands::optical_thickness(hair));
    const Shaded with = field.shade({.dual = true,
                                     .transmittance = 0.2f,
                                     .spread = 0.4,
                                     .at_rest = &hair,
                                     .head = within == Within::hair_on_head ? &head : nullptr});
    double worst = 0, brightest = 0;
    for (std::size_t k = 5; k < with.colors.size(); k += 311) {
      const glm::dvec3 to_eye = glm::normalize(glm::dvec3(0, 0, 1) - glm::dvec3(field.point(k)));
      const glm::dvec3 exact =
          k_irradiance * dual_scattering_at(glm::dvec3(field.tangent(k)), to_eye, double(0.2f), 0.4, corrections);
      const glm::dvec3 more = glm::dvec3(with.colors[k]) - glm::dvec3(without.colors[k]);
      for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(more[c] - exact[c]));
        brightest = std::max(brightest, exact[c]);
      }
    }
    std::printf("%s: off by %.5f of %.5f\n", within == Within::hair_alone ? "alone" : "on a head", worst, brightest);
    EXPECT_LT(worst, 0.01 * brightest);
  }
}

// No fibre scatters what a surface took away: a quarter of the light is a quarter of the radiance.
TEST(ShadeStrands, DualScattering_OfLightHalfBehindSurfaces_IsThatOfLessLight) {
  const Shaded &all = deep_in_hair(), part = Field().shade({.dual = true, .transmittance = 0.2f, .past = 0.25f});
  for (std::size_t k = 0; k < all.colors.size(); ++k)
    EXPECT_LT(glm::distance(glm::vec3(part.colors[k]), 0.25f * glm::vec3(all.colors[k])),
              2e-3f * glm::length(glm::vec3(all.colors[k])));
}

TEST(ShadeStrands, DualScattering_LeavesBlackHairAlone) {
  constexpr const char* k_black = "sigma_a=50/50/50,beta=0.2";
  const Field field;
  const double gain = brightness(field.shade({.dual = true, .transmittance = 0.2f, .material = k_black})) /
                      brightness(field.shade({.transmittance = 0.2f, .material = k_black}));
  std::printf("black: %.3f times as bright\n", gain);
  EXPECT_NEAR(gain, 1, 0.1);
}

}  // namespace
}  // namespace cuticle::render::shade_strands_gpu_test
