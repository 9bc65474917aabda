// Reads the camera of a checked scene file.
#include <numbers>

#include "scene/reader.h"

namespace cuticle::scene {

namespace {

void read_field_of_view(const Reader& reader, double& radians) {
  double degrees = radians * 180 / std::numbers::pi;
  reader.get("fov_deg", degrees);
  radians = degrees * std::numbers::pi / 180;
}

/// `name`: of the object that holds the view.
Result<void> check_view(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up,
                        const std::string& name) {
  if (position == target)
    return bad_input(fmt::format("{}: camera.position_m and target_m are the same point", name),
                     "let the camera look at a point that it is not in");
  if (glm::length(glm::cross(target - position, up)) > 0) return {};
  return bad_input(fmt::format("{}: camera.up is parallel to the view from position_m to target_m", name));
}

CameraKey first_key(const Camera& camera) {
  return {
      .position = camera.position, .target = camera.target, .vertical_field_of_view = camera.vertical_field_of_view};
}

Result<void> read_keys(const Reader& reader, CameraPath& path) {
  CameraKey key = first_key(path.camera);
  for (const Reader& fields : items(reader, "keys")) {
    const std::string name = fmt::format("{}: camera.keys[{}]", reader.where, path.keys.size());
    if (path.keys.empty() && path.automatic && !fields.has("position_m"))
      return bad_input(name + ".position_m is missing", "give it there or as camera.position_m");
    const double before = path.keys.empty() ? -1e6 : key.time;
    fields.get("time_s", key.time);
    fields.get("position_m", key.position);
    fields.get("target_m", key.target);
    read_field_of_view(fields, key.vertical_field_of_view);
    if (key.time < before)
      return bad_input(fmt::format("{}.time_s = {} is before {}, the key above's", name, key.time, before),
                       "put the keys in order");
    CUTICLE_TRY(check_view(key.position, key.target, path.camera.up, name));
    path.keys.push_back(key);
  }
  if (!path.keys.empty()) path.automatic = false;
  return {};
}

Result<void> check_planes(const Camera& camera, const std::string& where) {
  if (camera.near_plane < camera.far_plane) return {};
  return bad_input(
      fmt::format("{}: camera.near_m = {} is not below camera.far_m = {}", where, camera.near_plane, camera.far_plane));
}

}  // namespace

Result<void> read_camera(const Reader& reader, Scene& scene) {
  CameraPath& path = scene.camera;
  Camera& camera = path.camera;
  path.automatic = !reader.has("position_m");
  reader.get("position_m", camera.position);
  reader.get("target_m", camera.target);
  reader.get("up", camera.up);
  read_field_of_view(reader, camera.vertical_field_of_view);
  reader.get("near_m", camera.near_plane);
  reader.get("far_m", camera.far_plane);
  if (reader.has("resolution_px")) {
    const Json& size = reader.value["resolution_px"];
    camera.resolution = {int(size[0].number()), int(size[1].number())};
  }
  reader.get("turntable_deg_per_frame", path.turntable_degrees_per_frame);
  reader.get("follows_head", path.follows_head);
  CUTICLE_TRY(check_planes(camera, reader.where));
  if (!path.automatic) CUTICLE_TRY(check_view(camera.position, camera.target, camera.up, reader.where));
  return read_keys(reader, path);
}

}  // namespace cuticle::scene
