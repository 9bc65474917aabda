#pragma once
// Passes that make the strands which are drawn.
#include "render/pass.h"

namespace cuticle::render {

/// A pass of one dispatch a frame: from the rest of its entry. Before anything is shaded
/// (generate), or before anything is simulated (prepare).
inline Pass generating(registry::Entry entry, registry::Stage stage = registry::Stage::generate) {
  entry.kind = registry::EntryKind::pass;
  entry.stage = stage;
  entry.dispatches = [](const registry::ParameterValues&, const registry::FrameShape&) { return 1u; };
  return {entry};
}

}  // namespace cuticle::render
