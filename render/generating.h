#pragma once
// Passes that other modules record.
#include "render/pass.h"

namespace cuticle::render {

/// A pass that another module records, with one dispatch a frame: from the rest of its entry. Before anything is shaded
/// (generate), or before anything is simulated (prepare).
inline Pass generating(registry::Entry entry, registry::Stage stage = registry::Stage::generate) {
  entry.kind = registry::EntryKind::pass;
  entry.stage = stage;
  entry.dispatches = [](const registry::ParameterValues&, const registry::FrameShape&) { return 1u; };
  return {entry};
}

}  // namespace cuticle::render
