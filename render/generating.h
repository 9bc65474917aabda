#pragma once
// Passes that make the strands which are drawn.
#include "render/pass.h"
#include "strands/spline/drawn_parts.h"

namespace cuticle::render {

/// A pass of one dispatch a frame: from the rest of its entry. Before anything is shaded
/// (generate), or before anything is simulated (prepare).
inline Pass generating(registry::Entry entry, registry::Stage stage = registry::Stage::generate) {
  entry.kind = registry::EntryKind::pass;
  entry.stage = stage;
  entry.dispatches = [](const registry::ParameterValues&, const registry::FrameShape&) { return 1u; };
  return {entry};
}

/// Dispatches that write so many bytes of every drawn vertex.
inline std::uint32_t dispatches_of_drawn(const registry::FrameShape& shape,
                                         std::uint32_t bytes = strands::k_vertex_bytes) {
  const std::uint32_t size = shape.strands > 0 ? shape.vertices / shape.strands : 0;
  return strands::parts_of_strands(shape.max_storage_buffer_bytes, shape.strands, size, bytes);
}

/// A pass that writes all drawn vertices.
inline Pass writing_drawn(registry::Entry entry) {
  Pass pass = generating(entry);
  pass.entry.dispatches = [](const registry::ParameterValues&, const registry::FrameShape& shape) {
    return dispatches_of_drawn(shape);
  };
  return pass;
}

}  // namespace cuticle::render
