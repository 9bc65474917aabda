// Reads the colliders of a checked scene file.
#include <glm/trigonometric.hpp>

#include "scene/reader.h"

namespace cuticle::scene {

namespace {

/// By the keys turn_axis and turn_degrees; none unless given.
Result<glm::dquat> read_turn(const Reader& fields, const std::string& path) {
  double degrees = 0;
  fields.get("turn_degrees", degrees);
  if (degrees == 0) return glm::dquat(1, 0, 0, 0);
  CUTICLE_ASSIGN(const glm::dvec3 axis, direction(fields, "turn_axis", path));
  return glm::angleAxis(glm::radians(degrees), axis);
}

Sphere read_sphere(const Reader& fields) {
  Sphere sphere;
  fields.get("center_m", sphere.center);
  fields.get("radius_m", sphere.radius);
  return sphere;
}

RoundedBox read_capsule(const Reader& fields) {
  glm::dvec3 from(0), to(0);
  double radius = 0;
  fields.get("from_m", from);
  fields.get("to_m", to);
  fields.get("radius_m", radius);
  return make_capsule(from, to, radius);
}

Result<RoundedBox> read_box(const Reader& fields, const std::string& path) {
  RoundedBox box;
  fields.get("center_m", box.center);
  fields.get("size_m", box.half_size);
  box.half_size /= 2;
  fields.get("rounding_m", box.radius);
  CUTICLE_ASSIGN(const glm::dquat turn, read_turn(fields, path));
  box.axes = glm::mat3_cast(turn);
  return box;
}

Result<MeshCollider> read_mesh(const Reader& fields, const std::string& path) {
  MeshCollider mesh;
  CUTICLE_ASSIGN(mesh.file, fields.file("file", path + ".file"));
  fields.get("spacing_m", mesh.spacing);
  fields.get("metres_per_unit", mesh.metres_per_unit);
  return mesh;
}

Result<KeyedMotion> read_keys(const Reader& reader, const std::string& path) {
  KeyedMotion motion;
  for (const Reader& fields : items(reader, "keys")) {
    MotionKey key;
    fields.get("time_s", key.time);
    fields.get("position_m", key.place.position);
    CUTICLE_ASSIGN(key.place.rotation, read_turn(fields, fmt::format("{}.keys[{}]", path, motion.keys.size())));
    motion.keys.push_back(key);
  }
  if (motion.keys.empty())
    return bad_input(fmt::format("{}: {}.keys is empty; allowed: 1 .. 4096", reader.where, path));
  CUTICLE_TRY(check(motion, fmt::format("{}: {}", reader.where, path)));
  return motion;
}

/// A collider goes to those that move by themselves, or to the others of its kind.
template <class Kept>
Result<void> add(const Reader& fields, const std::string& path, Kept shape, std::vector<Kept>& with_head,
                 Scene& scene) {
  if (!fields.has("motion")) {
    with_head.push_back(std::move(shape));
    return {};
  }
  const Reader reader = fields.child("motion");
  MovingShape& moving = scene.moving_colliders.emplace_back(MovingShape{.shape = std::move(shape), .motion = {}});
  CUTICLE_ASSIGN(moving.motion, read_keys(reader, path + ".motion"));
  reader.get("on_head", moving.on_head);
  return {};
}

/// `read`: from the collider's keys and its path to the collider.
template <class Kept, class Read>
Result<void> read_each(const Reader& reader, const char* key, const Read& read, std::vector<Kept>& with_head,
                       Scene& scene) {
  std::size_t count = 0;
  for (const Reader& fields : items(reader, key)) {
    const std::string path = fmt::format("colliders.{}[{}]", key, count++);
    CUTICLE_ASSIGN(Kept shape, read(fields, path));
    CUTICLE_TRY(add(fields, path, std::move(shape), with_head, scene));
  }
  return {};
}

}  // namespace

Result<void> read_colliders(const Reader& reader, Scene& scene) {
  reader.get("head", scene.head_colliders);
  const auto sphere = [](const Reader& fields, const std::string&) { return Result<Sphere>(read_sphere(fields)); };
  const auto capsule = [](const Reader& fields, const std::string&) {
    return Result<RoundedBox>(read_capsule(fields));
  };
  CUTICLE_TRY(read_each(reader, "spheres", sphere, scene.colliders, scene));
  CUTICLE_TRY(read_each(reader, "capsules", capsule, scene.boxes, scene));
  CUTICLE_TRY(read_each(reader, "boxes", read_box, scene.boxes, scene));
  return read_each(reader, "meshes", read_mesh, scene.mesh_colliders, scene);
}

}  // namespace cuticle::scene
