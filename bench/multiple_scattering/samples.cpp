// What the fibres of a scene that the camera sees have before them, and what light they send by path tracing:
// multiple_scattering_samples SCENE FOLDER SAMPLES PER_PIXEL [METHOD[:NAME=VALUE,..] ...]. The scene's first light;
// transmittance by its shadow method, and by those that are named, at the vertices, as pictures have
// it. Writes the files that fit.cpp reads (README.md); with 0 samples about.f64 alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>

#include "bsdf/dual_scattering/dual_scattering.h"
#include "core/random.h"
#include "plan/camera_path.h"
#include "plan/plan.h"
#include "plan/traced_scene_runner.h"
#include "render/reference/camera_rays.h"
#include "render/reference/fibre_point.h"
#include "render/reference/reference.h"
#include "shadows/method.h"
#include "strands/thickness.h"

namespace {

using namespace cuticle;
using render::reference::TracedScene;

template <class T>
T must(Result<T> result) {
  if (result) return std::move(result).value();
  fmt::print(stderr, "{}\n", result.error().message);
  std::exit(3);
}

template <class T>
void write(const std::string& path, const std::vector<T>& values) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file || std::fwrite(values.data(), sizeof(T), values.size(), file) != values.size() || std::fclose(file) != 0) {
    fmt::print(stderr, "{}: cannot be written\n", path);
    std::exit(3);
  }
}

/// A shadow method and its values.
struct Shadow {
  const shadows::Method* method;
  registry::ParameterValues values;
};

Shadow shadow_from(const std::string& text) {
  const auto colon = std::min(text.find(':'), text.size());
  const shadows::Method* method = must(shadows::find_method(text.substr(0, colon)));
  const std::string set = text.substr(std::min(colon + 1, text.size()));
  return {method, must(registry::parse_assignments(method->entry.parameters, set))};
}

/// Values of some vertices, at their places among all.
std::vector<float> placed(const strands::Groom& hair, std::span<const std::uint32_t> vertices,
                          std::span<const float> values) {
  std::vector<float> of_all(hair.positions.size(), 1.f);
  for (std::size_t i = 0; i < vertices.size(); ++i) of_all[vertices[i]] = values[i];
  return of_all;
}

std::vector<float> at_vertices(const TracedScene& traced, const Shadow& shadow,
                               std::span<const std::uint32_t> vertices) {
  const strands::Groom& hair = traced.hair;
  std::vector<std::uint32_t> strand_of;
  std::vector<glm::vec3> points;
  for (const std::uint32_t v : vertices) {
    strand_of.push_back(std::uint32_t(std::ranges::upper_bound(hair.offsets, v) - hair.offsets.begin() - 1));
    points.push_back(hair.positions[v]);
  }
  const shadows::Receivers receivers{
      .points = points, .strands = strand_of, .vertices = vertices, .seen_from = traced.camera.position};
  const shadows::Casters casters{.groom = &hair, .alpha = 1, .to_light = traced.lights[0].to_light};
  return placed(hair, vertices, must(shadow.method->evaluate(casters, receivers, shadow.values)).values);
}

std::vector<strands::Mesh> meshes_of(const TracedScene& traced) {
  std::vector<strands::Mesh> meshes;
  for (const auto& surface : traced.surfaces) meshes.push_back(surface.mesh);
  return meshes;
}

/// 1 where surfaces let the light pass, as the pass surface_shadow has it with its bias of 4 mm.
std::vector<float> past_surfaces(const TracedScene& traced, std::span<const std::uint32_t> vertices) {
  constexpr double bias = 4e-3;
  const glm::dvec3 to_light = traced.lights[0].to_light;
  const auto surfaces = must(strands::RayScene::build({}, meshes_of(traced)));
  std::vector<float> past;
  for (const std::uint32_t v : vertices) {
    const glm::dvec3 from = glm::dvec3(traced.hair.positions[v]) + bias * to_light;
    past.push_back(surfaces->is_blocked(from, to_light, 1e3) ? 0.f : 1.f);
  }
  return placed(traced.hair, vertices, past);
}

/// A ray of a pixel that meets hair, between a vertex and the next.
struct SeenRay {
  std::uint32_t vertex = 0;
  std::array<float, 5> numbers;  ///< pixel, sin theta_i, sin theta_o, cos phi, share of the way to the next vertex
};

std::vector<SeenRay> rays_of_row(const TracedScene& traced, const strands::RayScene& rays,
                                 std::span<const glm::vec3> tangents, int y, int per_pixel) {
  const render::reference::CameraRays camera(traced.camera);
  RandomStream random{std::uint64_t(y) + 1};
  std::vector<SeenRay> seen;
  for (int k = 0; k < traced.camera.resolution.x * per_pixel; ++k) {
    const int x = k / per_pixel;
    const double right = random.next_unit(), down = random.next_unit();
    const auto ray = camera.through({x + right, y + down});
    const strands::RayHit hit = rays.closest(ray.origin, ray.direction);
    if (hit.kind != strands::RayHit::Kind::fibre) continue;
    const auto point = render::reference::fibre_point(traced.hair, tangents, hit, ray.origin, ray.direction);
    const glm::vec3 eye = point.local(-ray.direction), light = point.local(traced.lights[0].to_light);
    const float across = std::hypot(light.y, light.z) * std::hypot(eye.y, eye.z);
    const float cos_phi = across > 0 ? (light.y * eye.y + light.z * eye.z) / across : 0;
    seen.push_back({std::uint32_t(hit.vertex),
                    {float(y * traced.camera.resolution.x + x), light.x, eye.x, cos_phi, float(point.share)}});
  }
  return seen;
}

std::vector<SeenRay> rays_of_camera(const TracedScene& traced, int per_pixel) {
  const auto tangents = strands::tangents(traced.hair);
  const auto rays = must(strands::RayScene::build(traced.hair, meshes_of(traced)));
  std::vector<std::vector<SeenRay>> rows(static_cast<std::size_t>(traced.camera.resolution.y));
  tbb::parallel_for(std::size_t(0), rows.size(),
                    [&](std::size_t y) { rows[y] = rays_of_row(traced, *rays, tangents, int(y), per_pixel); });
  std::vector<SeenRay> seen;
  for (const auto& row : rows) seen.insert(seen.end(), row.begin(), row.end());
  return seen;
}

/// Rows of a ray's numbers, then for either vertex what passes surfaces and the transmittance by each method.
std::vector<float> seen_by_camera(const TracedScene& traced, std::span<const Shadow> shadows, int per_pixel) {
  const std::vector<SeenRay> rays = rays_of_camera(traced, per_pixel);
  std::vector<std::uint32_t> vertices;
  for (const SeenRay& ray : rays) vertices.insert(vertices.end(), {ray.vertex, ray.vertex + 1});
  std::ranges::sort(vertices);
  vertices.erase(std::ranges::unique(vertices).begin(), vertices.end());
  std::vector<std::vector<float>> transmittances{past_surfaces(traced, vertices)};
  for (const Shadow& shadow : shadows) transmittances.push_back(at_vertices(traced, shadow, vertices));
  std::vector<float> seen;
  for (const SeenRay& ray : rays) {
    seen.insert(seen.end(), ray.numbers.begin(), ray.numbers.end());
    for (const auto& at : transmittances) seen.insert(seen.end(), {at[ray.vertex], at[ray.vertex + 1]});
  }
  return seen;
}

/// Of each pixel: light scattered once, light scattered more multiple, variance of their sum; red, green, blue.
std::vector<float> light_of(const TracedScene& traced, int samples) {
  const auto picture = must(trace_picture(traced, {.layers = true}, {.samples = samples}, silent_progress()));
  const auto& names = picture.layers.channel_names;
  const auto at = [&](const std::string& name) { return int(std::ranges::find(names, name) - names.begin()); };
  std::vector<float> light;
  for (int y = 0; y < picture.layers.height; ++y)
    for (int x = 0; x < picture.layers.width; ++x) {
      const auto value = [&](const std::string& name) { return picture.layers.at(x, y, at(name)); };
      for (const char* c : {".R", ".G", ".B"}) light.push_back(value(std::string("single") + c));
      for (const char* c : {"R", "G", "B"}) light.push_back(value(c) - value(std::string("single.") + c));
      for (const char* c : {".R", ".G", ".B"}) light.push_back(value(std::string("variance") + c));
    }
  fmt::print("{} strands, {} samples, {:.1f} s\n", traced.hair.strand_count(), picture.samples, picture.seconds);
  return light;
}

std::vector<double> terms_of(const TracedScene& traced) {
  std::vector<double> numbers;
  const auto add = [&](const glm::dvec3& v) { numbers.insert(numbers.end(), {v.x, v.y, v.z}); };
  for (const auto& row : must(bsdf::dual_scattering_terms(*traced.model, traced.values, 32)).rows) {
    for (const auto* half : {&row.average.forward, &row.average.backward})
      add(half->share), add(half->shift), add(half->deviation * half->deviation);
    add(row.multiple.attenuation), add(row.multiple.shift), add(row.multiple.deviation * row.multiple.deviation);
  }
  return numbers;
}

TracedScene traced_scene(const scene::Scene& scene) {
  auto runner = must(plan::TracedSceneRunner::create(scene, silent_progress()));
  if (!runner->advance_to(0, silent_progress())) std::exit(3);
  TracedScene traced;
  traced.hair = must(runner->drawn_strands());
  traced.model = must(bsdf::find_model(scene.material.model.name));
  traced.values = scene.material.model.values;
  if (traced.values.all().contains("field")) traced.values.set("field", std::string("near"));
  traced.lights = {scene.lights.at(0)};
  if (const strands::Mesh& head = runner->set().head; !head.triangles.empty())
    traced.surfaces = {{head, std::vector<glm::vec3>(head.positions.size(), glm::vec3(0))}};
  traced.camera = plan::camera_at(scene.camera, strands::bounds(runner->set().control), {});
  return traced;
}

}  // namespace

int main(int count, char** given) {
  if (count < 5) {
    fmt::print(stderr, "multiple_scattering_samples SCENE FOLDER SAMPLES PER_PIXEL [METHOD[:NAME=VALUE,..] ...]\n");
    return 2;
  }
  const std::string folder = given[2];
  const scene::Scene scene = must(scene::load_scene(given[1], plan::catalogue()));
  const TracedScene traced = traced_scene(scene);
  const int samples = std::atoi(given[3]), per_pixel = std::atoi(given[4]);
  std::vector<Shadow> shadows{{must(shadows::find_method(scene.shadow->name)), scene.shadow->values}};
  for (int k = 5; k < count; ++k) shadows.push_back(shadow_from(given[k]));
  if (samples > 0) {
    if (!std::filesystem::exists(folder + "/light.f32")) write(folder + "/light.f32", light_of(traced, samples));
    write(folder + "/seen.f32", seen_by_camera(traced, shadows, per_pixel));
    if (!std::filesystem::exists(folder + "/terms.f64")) write(folder + "/terms.f64", terms_of(traced));
  }
  write(folder + "/about.f64",
        std::vector<double>{double(traced.camera.resolution.x), double(traced.camera.resolution.y), double(per_pixel),
                            traced.lights[0].irradiance.x, strands::optical_thickness(traced.hair),
                            double(shadows.size()), double(traced.surfaces.size())});
}
