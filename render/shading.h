#pragma once
// Passes that turn strands into pixels.
#include "render/pass.h"

namespace cuticle::render {

/// A pass of the stage that shades: from the rest of its entry.
inline Pass shading(registry::Entry entry) {
  entry.kind = registry::EntryKind::pass;
  entry.stage = registry::Stage::shade;
  return {entry};
}

/// The pass as one that cannot draw a picture in chunks.
inline Pass of_whole_pictures(Pass pass) {
  pass.whole_pictures = true;
  return pass;
}

/// `dispatches` of an entry that always makes as many.
template <std::uint32_t count>
std::uint32_t always(const registry::ParameterValues&, const registry::FrameShape&) {
  return count;
}

}  // namespace cuticle::render
