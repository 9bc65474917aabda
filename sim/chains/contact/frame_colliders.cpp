#include "sim/chains/contact/frame_colliders.h"

#include <glm/geometric.hpp>

#include "sim/colliders/distance_field.h"

namespace cuticle::sim::chains {
namespace {

template <class Real>
LinkBox<Real> link_box_of(const RoundedBox& box) {
  using Vector = glm::vec<3, Real>;
  return {Vector(box.center),  Real(box.radius),      Vector(box.axes[0]), Real(box.half_size.x),
          Vector(box.axes[1]), Real(box.half_size.y), Vector(box.axes[2]), Real(box.half_size.z)};
}

template <class Real>
LinkField<Real> link_field_of(const DistanceField& field) {
  const RoundedBox grid{.center = field.centre, .half_size = glm::dvec3(field.cells) * (field.spacing / 2)};
  return {link_box_of<Real>(grid), glm::vec<3, Real>(field.cells), Real(1 / field.spacing)};
}

RoundedBox moved(const RoundedBox& box, const Placement& place) {
  return {place.of(box.center), glm::mat3_cast(place.rotation) * box.axes, box.half_size, box.radius};
}

template <class Real>
LinkField<Real> moved(const DistanceField& field, const Placement& place) {
  LinkField<Real> link = link_field_of<Real>(field);
  link.grid = link_box_of<Real>(
      moved({.center = field.centre, .half_size = glm::dvec3(field.cells) * (field.spacing / 2)}, place));
  return link;
}

template <class Real>
ColliderCarry<Real> carry_of(const MovingPart& part) {
  using Vector = glm::vec<3, Real>;
  const glm::dmat3 rows = glm::transpose(glm::mat3_cast(part.end.rotation * glm::conjugate(part.begin.rotation)));
  const glm::dvec3 offset = part.end.position - part.begin.position * rows;
  return {Vector(rows[0]), Real(offset.x), Vector(rows[1]), Real(offset.y), Vector(rows[2]), Real(offset.z)};
}

/// Around a collider of that centre and size, in its own frame, at the substep's begin and end, in rest space.
template <class Real>
LinkSphere<Real> bound_of(const MovingPart& part, const glm::dquat& head_begin, const glm::dquat& head_end,
                          const glm::dvec3& centre, double size) {
  const glm::dvec3 from = glm::conjugate(head_begin) * part.begin.of(centre),
                   to = glm::conjugate(head_end) * part.end.of(centre);
  return {glm::vec<3, Real>(to), Real(size + glm::distance(from, to))};
}

/// All of a frame, those that the head takes along as well, boxes first.
struct Movers {
  std::vector<MovingCollider> with_head, spheres;  ///< the latter as boxes
  std::vector<const MovingCollider*> boxes, fields;
};
Movers movers_of(const FrameInput& input, bool on_skin) {
  Movers movers;
  for (const RoundedBox& box : input.boxes) movers.with_head.push_back({.shape = box, .motion = {}, .on_head = true});
  for (const FieldPointer& field : input.fields)
    movers.with_head.push_back({.shape = field, .motion = {}, .on_head = true});
  if (on_skin)
    for (const Sphere& sphere : input.colliders)
      movers.spheres.push_back(
          {.shape = make_capsule(sphere.center, sphere.center, sphere.radius), .motion = {}, .on_head = true});
  for (const MovingCollider& moving : input.moving)
    if (const auto* sphere = std::get_if<Sphere>(&moving.shape))
      movers.spheres.push_back(
          {make_capsule(sphere->center, sphere->center, sphere->radius), moving.motion, moving.on_head});
  const auto add = [&](const MovingCollider& mover) {
    if (std::holds_alternative<RoundedBox>(mover.shape)) movers.boxes.push_back(&mover);
    if (std::holds_alternative<FieldPointer>(mover.shape)) movers.fields.push_back(&mover);
  };
  for (const std::span<const MovingCollider> group : {std::span<const MovingCollider>(movers.with_head), input.moving,
                                                      std::span<const MovingCollider>(movers.spheres)})
    for (const MovingCollider& mover : group) add(mover);
  return movers;
}

template <class Real>
void add_substep(std::span<const MovingCollider* const> movers, std::span<const MovingPart> parts,
                 const glm::dquat& begin, const glm::dquat& end, FrameColliders<Real>& colliders) {
  for (std::size_t k = 0; k < movers.size(); ++k) {
    colliders.carries.push_back(carry_of<Real>(parts[k]));
    if (const auto* box = std::get_if<RoundedBox>(&movers[k]->shape)) {
      colliders.boxes.push_back(link_box_of<Real>(moved(*box, parts[k].end)));
      colliders.bounds.push_back(
          bound_of<Real>(parts[k], begin, end, box->center, box->radius + glm::length(box->half_size)));
    } else {
      const DistanceField& field = *std::get<FieldPointer>(movers[k]->shape);
      const double size = glm::length(glm::dvec3(field.cells)) * field.spacing / 2;
      colliders.fields.push_back(moved<Real>(field, parts[k].end));
      colliders.bounds.push_back(bound_of<Real>(parts[k], begin, end, field.centre, size));
    }
  }
}

template <class Real>
void add_moving(const FrameInput& input, bool on_skin, FrameColliders<Real>& colliders) {
  const Movers movers = movers_of(input, on_skin);
  std::vector<const MovingCollider*> all = movers.boxes;
  all.insert(all.end(), movers.fields.begin(), movers.fields.end());
  const std::vector<MovingPart> parts = moving_parts(input, all, colliders.substeps);
  const HeadWay way(input);
  for (std::size_t k = 0; k < colliders.substeps; ++k)
    add_substep<Real>(all, std::span(parts).subspan(k * all.size(), all.size()),
                      way.turn(double(k) / double(colliders.substeps)),
                      way.turn(double(k + 1) / double(colliders.substeps)), colliders);
  for (const MovingCollider* mover : movers.fields) colliders.baked.push_back(std::get<FieldPointer>(mover->shape));
}

/// The numbers of the moving colliders that are in reach.
template <class Real, class Reached>
std::vector<std::size_t> moving_in_reach(const FrameColliders<Real>& all, const Reached& reached) {
  const std::size_t count = all.box_count() + all.field_count();
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = k; i < all.bounds.size(); i += count)
      if (reached(all.bounds[i])) {
        found.push_back(k);
        break;
      }
  return found;
}

template <class Real, class Reached>
void find_near_moving(const FrameColliders<Real>& all, FrameColliders<Real>& near, const Reached& reached) {
  const std::vector<std::size_t> found = moving_in_reach(all, reached);
  const std::size_t boxes = all.box_count(), fields = all.field_count();
  near.carries.clear();
  near.substeps = all.substeps;
  for (std::size_t step = 0; step < all.substeps; ++step)
    for (std::size_t k : found) {
      near.carries.push_back(all.carries[step * (boxes + fields) + k]);
      if (k < boxes)
        near.boxes.push_back(all.boxes[step * boxes + k]);
      else
        near.fields.push_back(all.fields[step * fields + k - boxes]);
    }
  for (std::size_t k : found)
    if (k >= boxes) near.baked.push_back(all.baked[k - boxes]);
}

}  // namespace

template <class Real>
FrameColliders<Real> frame_colliders(const ChainSettings& settings, const FrameInput& input, std::size_t substeps,
                                     bool on_skin) {
  FrameColliders<Real> colliders;
  if (!settings.contact) return colliders;
  if (on_skin) {
    FrameInput still = input;
    still.head_begin = still.head_end = glm::dmat4(1);
    colliders.substeps = substeps;
    add_moving(still, true, colliders);
    return colliders;
  }
  for (const Sphere& sphere : input.colliders)
    colliders.spheres.push_back({glm::vec<3, Real>(sphere.center), Real(sphere.radius)});
  if (!input.moving.empty()) {
    colliders.substeps = substeps;
    add_moving(input, false, colliders);
    return colliders;
  }
  for (const RoundedBox& box : input.boxes) colliders.boxes.push_back(link_box_of<Real>(box));
  for (const FieldPointer& field : input.fields) colliders.fields.push_back(link_field_of<Real>(*field));
  colliders.baked.assign(input.fields.begin(), input.fields.end());
  return colliders;
}
template FrameColliders<float> frame_colliders<float>(const ChainSettings&, const FrameInput&, std::size_t, bool);
template FrameColliders<double> frame_colliders<double>(const ChainSettings&, const FrameInput&, std::size_t, bool);

template <class Real>
void find_near(const FrameColliders<Real>& all, const std::function<bool(const LinkSphere<Real>&)>& reached,
               FrameColliders<Real>& near) {
  near.spheres.clear();
  near.boxes.clear();
  near.fields.clear();
  near.baked.clear();
  for (const LinkSphere<Real>& sphere : all.spheres)
    if (reached(sphere)) near.spheres.push_back(sphere);
  if (!all.carries.empty()) return find_near_moving(all, near, reached);
  near.carries.clear();
  near.substeps = 1;
  for (const LinkBox<Real>& box : all.boxes)
    if (reached(sphere_around(box))) near.boxes.push_back(box);
  for (std::size_t k = 0; k < all.fields.size(); ++k) {
    if (!reached(sphere_around(all.fields[k].grid))) continue;
    near.fields.push_back(all.fields[k]);
    near.baked.push_back(all.baked[k]);
  }
}
template void find_near<float>(const FrameColliders<float>&, const std::function<bool(const LinkSphere<float>&)>&,
                               FrameColliders<float>&);
template void find_near<double>(const FrameColliders<double>&, const std::function<bool(const LinkSphere<double>&)>&,
                                FrameColliders<double>&);

}  // namespace cuticle::sim::chains
