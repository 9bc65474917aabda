#include "sim/colliders/contact.h"

namespace cuticle::sim::colliders {
namespace {

constexpr std::string_view k_demands[] = {"simulation", "colliders"};
constexpr std::string_view k_systems[] = {"N9", "G8"};
constexpr std::string_view k_after[] = {"classic", "exact"};

/// Contact and lengths in turn, once per substep (none of its own with a solver that fuses its effects).
std::uint32_t dispatches(const registry::ParameterValues&, const registry::FrameShape& shape) { return shape.substeps; }

}  // namespace

void describe(registry::Members& members, ContactSettings& contact) {
  members(contact.pearl_radius, "pearl_radius", "m", 0, 1, "radius of the sphere on every particle");
  members(contact.fit_pearls, "fit_pearls",
          "grow each pearl until its straight segments clear the collider (classic; exact clears segments without)");
  members(contact.friction, "friction", "1", 0, 10,
          "Coulomb's coefficient between hair and collider (exact; classic slides freely)");
}

const Effect& entry() {
  static const Effect effect = {
      .entry = {.kind = registry::EntryKind::effect,
                .name = ContactSettings::name,
                .summary = "spheres, capsules, boxes and meshes push strands out (classic: spheres, with pearls on "
                           "particles)",
                .source = "Nalu, GPU Gems 2, chapter 23, collision",
                .parameters = registry::table_of<ContactSettings>(),
                .demands = k_demands,
                .stage = registry::Stage::simulate,
                .systems = k_systems,
                .dispatches = dispatches,
                .after = k_after}};
  return effect;
}

}  // namespace cuticle::sim::colliders
