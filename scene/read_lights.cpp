#include <glm/trigonometric.hpp>

#include "scene/environment.h"
#include "scene/reader.h"

namespace cuticle::scene {

namespace {

/// The cone of a spot, from its point light.
Result<void> read_spot(const Reader& light, const std::string& path, PointLight& point_light) {
  if (!light.has("spot")) return {};
  const Reader reader = light.child("spot");
  glm::dvec3 to(0);
  double inner = 0, outer = 0;
  reader.get("to_m", to);
  reader.get("inner_deg", inner);
  reader.get("outer_deg", outer);
  if (inner >= outer)
    return bad_input(
        fmt::format("{}: {}.spot.inner_deg = {} is not below outer_deg = {}", light.where, path, inner, outer));
  if (!(glm::length(to - point_light.position) > 0))
    return bad_input(fmt::format("{}: {}.spot.to_m is where the point light stands", light.where, path));
  point_light.axis = glm::normalize(to - point_light.position);
  point_light.inner_angle = glm::radians(inner);
  point_light.outer_angle = glm::radians(outer);
  return {};
}

Result<PointLight> read_point_light(const Reader& reader, const std::string& path) {
  PointLight point_light;
  reader.get("position_m", point_light.position);
  reader.get("intensity", point_light.intensity);
  CUTICLE_TRY(read_spot(reader, path, point_light));
  return point_light;
}

Result<void> read_distant_lights(const Reader& root, Scene& scene) {
  if (!root.has("lights")) return {};
  for (const Json& item : root.value["lights"]) {
    const Reader reader{item, root.where, root.folder};
    Light light;
    reader.get("name", light.name);
    reader.get("irradiance", light.irradiance);
    CUTICLE_ASSIGN(light.to_light, direction(reader, "to_light", fmt::format("lights[{}]", scene.lights.size())));
    scene.lights.push_back(light);
  }
  return {};
}

Result<void> read_point_lights(const Reader& root, Scene& scene) {
  std::size_t count = 0;
  for (const Reader& reader : items(root, "point_lights")) {
    Light light;
    reader.get("name", light.name);
    CUTICLE_ASSIGN(light.point_light, read_point_light(reader, fmt::format("point_lights[{}]", count++)));
    scene.lights.push_back(light);
  }
  if (scene.lights.size() <= k_max_lights) return {};
  return bad_input(fmt::format("{}: point_lights: {} beside {} of `lights`; allowed are {} in all", root.where, count,
                               scene.lights.size() - count, k_max_lights));
}

/// The picture's name; empty for the built-in sky, which a scene may ask for where the file is not there.
Result<std::string> surroundings_file(const Reader& reader, Scene& scene) {
  bool or_sky = false;
  reader.get("or_sky", or_sky);
  auto name = reader.file("file", "environment.file");
  if (name || !or_sky) return name;
  scene.notes.push_back(name.error().message + "; the built-in sky is used");
  return std::string();
}

Result<void> read_environment(const Reader& root, Scene& scene) {
  if (!root.has("environment")) return {};
  const Reader reader = root.child("environment");
  Environment environment;
  reader.get("lights", environment.lights);
  reader.get("turn_deg", environment.turn_degrees);
  reader.get("scale", environment.scale);
  if (scene.lights.size() + std::size_t(environment.lights) > k_max_lights)
    return bad_input(
        fmt::format("{}: environment.lights: {} beside {} of `lights` and `point_lights`; allowed are {} in all",
                    root.where, environment.lights, scene.lights.size(), k_max_lights));
  CUTICLE_ASSIGN(const std::string name, surroundings_file(reader, scene));
  CUTICLE_ASSIGN(const Image picture, surroundings_of(name));
  const auto lights = environment_lights(picture, environment);
  if (!lights) return bad_input(fmt::format("{}: {}: {}", root.where, name, lights.error().message));
  scene.environment = {name, environment, lights->size()};
  scene.lights.insert(scene.lights.end(), lights->begin(), lights->end());
  return {};
}

}  // namespace

Result<void> read_lights(const Reader& root, Scene& scene) {
  CUTICLE_TRY(read_distant_lights(root, scene));
  CUTICLE_TRY(read_point_lights(root, scene));
  return read_environment(root, scene);
}

}  // namespace cuticle::scene
