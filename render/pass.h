#pragma once
// The concept of a render pass: one folder each, with its demands, its shader and its cost.
#include <span>
#include <string_view>

#include "core/registry/entry.h"
#include "core/result.h"

namespace cuticle::render {

struct Pass {
  registry::Entry entry;
  bool whole_pictures = false;  ///< draws or looks at all of a picture at once, so that it cannot be drawn in chunks
};
std::span<const Pass* const> passes();

}  // namespace cuticle::render
