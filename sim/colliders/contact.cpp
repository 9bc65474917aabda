#include "sim/colliders/contact.h"

#include <algorithm>

#include "sim/colliders/contact.glslh"
#include "sim/head_motion.h"
#include "sim/turn.glslh"

namespace cuticle::sim::colliders {
namespace {

/// A sphere as the strand meets it.
struct Met {
  glm::vec3 centre;
  float sphere_radius, anchor_distance;

  Met(const Contact& contact, const glm::vec4& sphere)
      : centre(turned(glm::vec3(sphere), glm::vec3(contact.rotation), contact.rotation.w)),
        sphere_radius(sphere.w),
        anchor_distance(glm::length(contact.places[contact.anchor] - centre)) {}
  /// Distance at which a vertex is held.
  float radius(const glm::vec4& traits, const ContactSettings& settings) const {
    const float pearl = pearl_of(sphere_radius, traits.w, settings.pearl_radius, settings.fit_pearls ? 1.f : 0.f);
    return contact_radius(sphere_radius, pearl, anchor_distance, traits.z);
  }
};

void push_out_of(const Contact& contact, const glm::vec4& sphere, const ContactSettings& settings) {
  const Met met(contact, sphere);
  for (std::size_t i = contact.anchor + 1; i < contact.places.size(); ++i)
    contact.places[i] =
        pushed_out(contact.places[i], met.centre, met.radius(contact.traits[i], settings), contact.fallback);
}

bool touches_one(const Contact& contact, const glm::vec4& sphere, const ContactSettings& settings) {
  const Met met(contact, sphere);
  for (std::size_t i = contact.anchor + 1; i < contact.places.size(); ++i)
    if (is_pushed(contact.places[i], met.centre, met.radius(contact.traits[i], settings))) return true;
  return false;
}

void append(std::vector<glm::vec4>& packed, std::span<const Sphere> still,
            std::span<const MovingCollider* const> moving, std::span<const MovingPart> parts,
            Placement MovingPart::*end, const glm::dquat& head) {
  for (const Sphere& sphere : still) packed.emplace_back(glm::vec3(sphere.center), float(sphere.radius));
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const Sphere& sphere = std::get<Sphere>(moving[i]->shape);
    packed.emplace_back(glm::vec3(glm::conjugate(head) * (parts[i].*end).of(sphere.center)), float(sphere.radius));
  }
}

}  // namespace

std::vector<glm::vec4> packed(std::span<const Sphere> spheres) {
  std::vector<glm::vec4> result;
  for (const Sphere& sphere : spheres) result.emplace_back(glm::vec3(sphere.center), static_cast<float>(sphere.radius));
  return result;
}

SubstepSpheres packed(const FrameInput& input, std::size_t substeps) {
  std::vector<const MovingCollider*> moving;
  for (const MovingCollider& collider : input.moving)
    if (std::holds_alternative<Sphere>(collider.shape)) moving.push_back(&collider);
  SubstepSpheres result{packed(input.colliders), input.colliders.size() + moving.size(), !moving.empty()};
  if (!result.move) return result;
  result.spheres.clear();
  const std::vector<MovingPart> parts = moving_parts(input, moving, substeps);
  const HeadWay way(input);
  for (std::size_t k = 0; k < substeps; ++k) {
    const std::span own = std::span(parts).subspan(k * moving.size(), moving.size());
    const double n = double(substeps);
    append(result.spheres, input.colliders, moving, own, &MovingPart::begin, way.turn(double(k) / n));
    append(result.spheres, input.colliders, moving, own, &MovingPart::end, way.turn(double(k + 1) / n));
  }
  return result;
}

bool touches(const Contact& contact, std::span<const glm::vec4> spheres, const ContactSettings& settings) {
  return std::ranges::any_of(spheres, [&](const glm::vec4& sphere) { return touches_one(contact, sphere, settings); });
}

void push_out(const Contact& contact, std::span<const glm::vec4> spheres, const ContactSettings& settings) {
  for (const glm::vec4& sphere : spheres) push_out_of(contact, sphere, settings);
}

}  // namespace cuticle::sim::colliders
