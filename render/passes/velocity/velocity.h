#pragma once
#include <string_view>

#include "core/registry/members.h"
#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render::velocity {

struct Parameters {
  static constexpr std::string_view name = "velocity";
  std::uint32_t nodes = 24;
};
void describe(registry::Members& members, Parameters& parameters);

/// How what a pixel sees has moved since the frame before.
struct MotionVectors;
constexpr std::string_view resource_name(const MotionVectors*) { return "motion_vectors"; }

/// The registry's entry of the pass.
const Pass& entry();

/// What it writes per pixel, as EXR names it: how far what the pixel sees of the hair has moved on the screen since the
/// frame before, pixels, right and down. 0 where no hair is seen.
inline constexpr std::string_view k_channels[] = {"velocity.X", "velocity.Y"};

}  // namespace cuticle::render::velocity
