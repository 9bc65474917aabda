#pragma once
// Small scenes of cards, drawn on the software device.
#include "render/pass_gpu.h"
#include "render/passes/cards/cards.h"
#include "render/passes/surface_shadow/surface_shadow_gpu.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "strands/cards/hair_cards.h"
#include "tests/support/drawn_strands.h"

namespace cuticle::render::cards_gpu_test {

using tests::device, tests::mean_difference, tests::upload;

inline constexpr int k_size = 96, k_vertices = 9;
using Settings = std::vector<std::pair<const char*, registry::Value>>;

struct Scene {
  strands::Groom groom;               ///< at rest, k_vertices a strand
  std::vector<glm::vec3> moved = {};  ///< positions of the frame; empty: at rest
  std::vector<float> reached = {};    ///< transmittance per vertex; empty: nothing shadows
  std::vector<float> past = {};       ///< what passes surfaces, a part of that; empty: they cast nothing
  bool shadowed_by_hair = true;       ///< a method is in that transmittance
  bool dual = false;                  ///< dual scattering is asked for
  glm::dmat4 motion{1};               ///< of the head
  Camera camera = {.position = {0, -0.1, 1}, .target = {0, -0.1, 0}, .vertical_field_of_view = 0.4};
  std::vector<Light> lights = {
      {.name = "", .to_light = glm::normalize(glm::dvec3(0.5, 0.6, 1)), .irradiance = {1, 2, 3}}};
  std::string model = "scheuermann", material = "";
  Settings settings = {};
  bool draws_head = false;
  /// As good as a point at the origin.
  strands::Mesh head = {{{-1e-4f, 0, 0}, {1e-4f, 0, 0}, {0, 0, 0}}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {}, {{0, 1, 2}}};
};

inline void add_strand(strands::Groom& groom, const glm::vec3& root, const glm::vec3& step, float radius) {
  for (int k = 0; k < k_vertices; ++k) groom.positions.push_back(root + float(k) * step);
  groom.radii.resize(groom.positions.size(), radius);
  groom.offsets.push_back(std::uint32_t(groom.positions.size()));
}

inline float number(RandomStream& random, float least, float most) {
  return least + (most - least) * float(random.next_unit());
}

/// Hair around a head at the origin that hangs down 20 cm.
inline strands::Groom locks() {
  strands::Groom groom;
  RandomStream random(3);
  for (int s = 0; s < 400; ++s) {
    const float turn = 6.2831853f * number(random, 0, 1), far = number(random, 0.06f, 0.1f);
    const glm::vec3 out(std::cos(turn), 0, std::sin(turn));
    add_strand(groom, far * out, 0.025f * (0.15f * out - glm::vec3(0, 1, 0)), 8e-4f);
  }
  return groom;
}

/// A lock 2 cm wide, 20 cm long, at this depth, facing +z.
inline void add_lock(strands::Groom& groom, float z, std::uint64_t seed) {
  RandomStream random(seed);
  for (int s = 0; s < 20; ++s)
    add_strand(groom, {number(random, -0.05f, 0.05f), 0, z + number(random, -1e-3f, 1e-3f)},
               {number(random, -0.001f, 0.001f), -0.025f, 0}, 1e-3f);
}

inline registry::ParameterValues parameters_of(const Scene& scene) {
  registry::ParameterValues values = registry::default_values(cards::entry().entry.parameters);
  values.set("texture_width", std::int64_t(32));
  values.set("texture_height", std::int64_t(64));
  values.set("cards", std::int64_t(60));
  for (const auto& [name, value] : scene.settings) values.set(name, value);
  return values;
}

struct Drawn {
  Image image;
  gpu::SubmitCost cost;
  std::vector<std::string> notes;
  /// Past the tests of depth, by the shader's own count.
  std::uint64_t shaded(const std::string& step) const {
    for (const std::string& note : notes)
      if (note.starts_with(step + ": ")) return std::stoull(note.substr(step.size() + 2));
    ADD_FAILURE() << step << " was not counted";
    return 0;
  }
  /// All that covers a pixel, by the device's statistics.
  std::uint64_t covered(std::string_view step) const {
    const auto found = std::ranges::find(cost.fragments, step, &gpu::FragmentCount::name);
    return found == cost.fragments.end() ? 0 : found->invocations;
  }
};

inline Result<Drawn> try_draw(const Scene& scene) {
  using gpu::TextureFormat;
  std::vector<glm::vec4> positions;
  for (std::size_t v = 0; v < scene.groom.vertex_count(); ++v)
    positions.emplace_back(scene.moved.empty() ? scene.groom.positions[v] : scene.moved[v], scene.groom.radii[v]);
  const gpu::Buffer vertices = upload(positions);
  const glm::ivec2 size(k_size);
  const gpu::Texture color = tests::target(size, TextureFormat::rgba32f),
                     depth = tests::target(size, TextureFormat::depth32f);
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(scene.model));
  CUTICLE_ASSIGN(const auto material, registry::parse_assignments(model->entry.parameters, scene.material));
  Resources resources;
  resources.edit<FrameView>().camera = scene.camera;
  resources.edit<FrameView>().camera.resolution = size;
  resources.edit<Lights>().all = scene.lights;
  const gpu::Buffer reached = upload(scene.reached.empty() ? std::vector<float>{1} : scene.reached);
  if (!scene.reached.empty()) resources.edit<HairTransmittance>().reached = {&reached};
  resources.edit<HairTransmittance>().of_surfaces_alone = !scene.shadowed_by_hair;
  surface_shadow::Maps maps;
  if (!scene.past.empty()) {
    maps.visibility = upload(scene.past);
    resources.put_reference(maps);
  }
  resources.edit<DrawnHair>().strands.vertices = &vertices;
  resources.edit<DrawnHair>().strands.vertex_count = std::uint32_t(positions.size());
  resources.edit<DrawnHair>().vertices_per_strand = k_vertices;
  resources.edit<RestStrands>().groom = &scene.groom;
  resources.edit<FibreMaterial>().model = model;
  resources.edit<FibreMaterial>().values = &material;
  resources.edit<Surfaces>().head = &scene.head;
  resources.edit<Surfaces>().head_transform = scene.motion;
  resources.edit<Targets>().color = resources.edit<Targets>().resolved = &color;
  resources.edit<Targets>().depth = &depth;
  resources.edit<Targets>().supersampling = 1;
  resources.parameters["cards"] = parameters_of(scene);
  gpu::Commands commands = device()->record();
  std::vector<std::unique_ptr<GpuPass>> passes;
  for (std::string_view name : {"dual_scattering", "head", "cards"}) {
    if ((name == "head" && !scene.draws_head) || (name == "dual_scattering" && !scene.dual)) continue;
    const auto entry = std::ranges::find(gpu_passes(), name, &GpuPassEntry::name);
    CUTICLE_ASSIGN(auto pass, (*entry)->create(device(), resources));
    pass->publish(resources);
    CUTICLE_TRY(pass->record(commands, resources));
    resources.edit<Targets>().keep = name != "dual_scattering";
    passes.push_back(std::move(pass));
  }
  Drawn drawn{.image = make_image(k_size, k_size, {"R", "G", "B", "A"}), .cost = {}, .notes = {}};
  CUTICLE_ASSIGN(drawn.cost, device()->submit(std::move(commands)));
  CUTICLE_ASSIGN(const Settled settled, passes.back()->settle());
  drawn.notes = settled.notes;
  CUTICLE_ASSIGN(drawn.image.pixels, device()->download(color));
  return drawn;
}

inline Drawn draw(const Scene& scene) {
  auto drawn = try_draw(scene);
  EXPECT_TRUE(drawn) << (drawn ? "" : drawn.error().message);
  return std::move(*drawn);
}

inline double largest_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t p = 0; p < a.pixels.size(); ++p)
    largest = std::max(largest, double(std::abs(a.pixels[p] - b.pixels[p])));
  return largest;
}

}  // namespace cuticle::render::cards_gpu_test
