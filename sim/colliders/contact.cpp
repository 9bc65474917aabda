#include <cuticle/sim/colliders/contact.h>

#include <cuticle/sim/colliders/contact.glslh>
#include <cuticle/sim/turn.glslh>

namespace cuticle::sim::colliders {
namespace {

glm::vec3 turned_place(const glm::vec4& place, const glm::vec4& rotation) {
  return turned(glm::vec3(place), glm::vec3(rotation), rotation.w);
}

/// A sphere at one end of the substep.
struct PlacedSphere {
  glm::vec3 centre;
  float radius, anchor_distance;
};
PlacedSphere placed(const glm::vec4& sphere, const glm::vec4& rotation, const glm::vec3& anchor) {
  const glm::vec3 centre = turned_place(sphere, rotation);
  return {centre, sphere.w, glm::length(anchor - centre)};
}

void push_vertex(glm::vec3& place, const PlacedSphere& sphere, const glm::vec4& traits, float pearl, const glm::vec3& fallback) {
  const float radius = contact_radius(sphere.radius, pearl, sphere.anchor_distance, traits.z);
  place = pushed_out(place, sphere.centre, radius, fallback);
}

}  // namespace

ContactSettings make_contact_settings(const registry::ParameterValues& values) {
  return {static_cast<float>(values.real("pearl_radius")), values.boolean("fit_pearls")};
}

std::vector<glm::vec4> packed(std::span<const Sphere> spheres) {
  std::vector<glm::vec4> result;
  for (const Sphere& sphere : spheres) result.emplace_back(glm::vec3(sphere.center), static_cast<float>(sphere.radius));
  return result;
}

void push_out(const Contact& contact, std::span<const glm::vec4> spheres, const ContactSettings& settings) {
  for (const glm::vec4& sphere : spheres) {
    const PlacedSphere end = placed(sphere, contact.rotation_end, contact.positions[contact.anchor]);
    const PlacedSphere begin = placed(sphere, contact.rotation_begin, contact.starts[contact.anchor]);
    for (std::size_t i = contact.anchor + 1; i < contact.positions.size(); ++i) {
      const glm::vec4& traits = contact.traits[i];
      const float pearl = pearl_of(sphere.w, traits.w, settings.pearl_radius, settings.fit_pearls ? 1.f : 0.f);
      push_vertex(contact.positions[i], end, traits, pearl, contact.fallback);
      push_vertex(contact.starts[i], begin, traits, pearl, contact.fallback);
    }
  }
}

}  // namespace cuticle::sim::colliders
