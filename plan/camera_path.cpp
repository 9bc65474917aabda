#include "plan/camera_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace cuticle::plan {

namespace {

using scene::CameraKey;

Camera framed(Camera camera, const strands::Bounds& bounds) {
  const glm::dvec3 lower(bounds.lower), upper(bounds.upper);
  const double radius = std::max(1e-3, 0.5 * glm::distance(lower, upper));
  const double aspect = std::min(1.0, double(camera.resolution.x) / camera.resolution.y);
  const double half = std::atan(std::tan(camera.vertical_field_of_view / 2) * aspect);
  const double distance = radius / std::sin(half);
  camera.target = 0.5 * (lower + upper);
  camera.position = camera.target + distance * glm::normalize(glm::dvec3(0.55, 0.2, 1));
  camera.near_plane = std::max(1e-4, distance - 2 * radius);
  camera.far_plane = distance + 4 * radius;
  return camera;
}

/// What a key moves, as one vector of numbers.
struct View {
  glm::dvec3 position, target;
  double field_of_view;
};
View view_of(const CameraKey& key) { return {key.position, key.target, key.vertical_field_of_view}; }
View sum(const View& a, double factor, const View& b) {
  return {a.position + factor * b.position, a.target + factor * b.target, a.field_of_view + factor * b.field_of_view};
}

/// Change of the view per second from one key to a later one.
View slope(const CameraKey& from, const CameraKey& to) {
  const double rate = 1 / (to.time - from.time);
  const View change = sum(view_of(to), -1, view_of(from));
  return {rate * change.position, rate * change.target, rate * change.field_of_view};
}

/// Velocity at keys[i] beside the stretch from keys[first] to the key after it: across a cut nothing is looked at.
View velocity_at(const std::vector<CameraKey>& keys, std::size_t i, std::size_t first) {
  const std::size_t before = i == 0 || keys[i - 1].time == keys[i].time ? i : i - 1;
  const std::size_t after = i + 1 == keys.size() || keys[i + 1].time == keys[i].time ? i : i + 1;
  return slope(keys[std::min(before, first)], keys[std::max(after, first + 1)]);
}

/// The cubic of Hermite between keys[first] and the next.
View between(const std::vector<CameraKey>& keys, std::size_t first, double time) {
  const CameraKey &a = keys[first], &b = keys[first + 1];
  const double span = b.time - a.time, u = (time - a.time) / span, u2 = u * u, u3 = u2 * u;
  View view = sum({}, 2 * u3 - 3 * u2 + 1, view_of(a));
  view = sum(view, 3 * u2 - 2 * u3, view_of(b));
  view = sum(view, span * (u3 - 2 * u2 + u), velocity_at(keys, first, first));
  return sum(view, span * (u3 - u2), velocity_at(keys, first + 1, first));
}

View at_keys(const std::vector<CameraKey>& keys, double time) {
  const auto later = std::upper_bound(keys.begin(), keys.end(), time,
                                      [](double wanted, const CameraKey& key) { return wanted < key.time; });
  if (later == keys.begin()) return view_of(keys.front());
  if (later == keys.end()) return view_of(keys.back());
  return between(keys, std::size_t(later - keys.begin()) - 1, time);
}

/// Cubics may pass their keys.
constexpr double k_least_field = 0.01, k_max_field = 3;

Camera at_time(const scene::CameraPath& path, double seconds) {
  Camera camera = path.camera;
  const View view = at_keys(path.keys, seconds);
  camera.position = view.position;
  camera.target = view.target;
  camera.vertical_field_of_view = std::clamp(view.field_of_view, k_least_field, k_max_field);
  return camera;
}

Camera untravelled(const scene::CameraPath& path, const strands::Bounds& rest, double seconds) {
  if (!path.keys.empty()) return at_time(path, seconds);
  return path.automatic ? framed(path.camera, rest) : path.camera;
}

}  // namespace

Camera camera_at(const scene::CameraPath& path, const strands::Bounds& rest, const CameraTime& when) {
  Camera camera = untravelled(path, rest, when.seconds);
  const double angle = path.turntable_degrees_per_frame * when.frame * std::numbers::pi / 180;
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1), angle, glm::dvec3(0, 1, 0)));
  const glm::dvec3 travel = path.follows_head ? when.head_travel : glm::dvec3(0);
  camera.position = camera.target + turn * (camera.position - camera.target) + travel;
  camera.target += travel;
  return camera;
}

}  // namespace cuticle::plan
