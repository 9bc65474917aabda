#pragma once
#include "core/registry/members.h"
#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render::seen_vertices {

struct Parameters {
  static constexpr std::string_view name = "seen_vertices";
  bool wanted = true;
};
void describe(registry::Members& members, Parameters& parameters);

/// The vertices of segments of which a picture by `tiles` shows something.
struct SeenVertices;
constexpr std::string_view resource_name(const SeenVertices*) { return "seen_vertices"; }

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::seen_vertices
