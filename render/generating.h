#pragma once
// Passes that other modules record.
#include <cuticle/render/pass.h>

namespace cuticle::render {

/// A pass that another module records, before anything is shaded, with one dispatch a frame: from the rest of its
/// entry.
inline Pass generating(registry::Entry entry) {
  entry.kind = registry::EntryKind::pass;
  entry.stage = registry::Stage::generate;
  entry.dispatches = [](const registry::ParameterValues&, const registry::FrameShape&) { return 1u; };
  return {entry};
}

}  // namespace cuticle::render
