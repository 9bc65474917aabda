#pragma once
// The tables that strands are shaded from.
#include <vector>

#include "lut/table_set.h"
#include "render/pass_gpu.h"
#include "render/passes/bake_tables/bake_tables.h"

namespace cuticle::render::bake_tables {

struct Tables {
  std::vector<const gpu::Texture*> textures = {};  ///< as strand_shading::upload_drawn makes them
  const lut::TableSet* set = nullptr;
};

/// Null: no tables are baked.
inline const lut::TableSet* table_set_of(const Resources& resources) {
  const Tables* const tables = resources.find<Tables>();
  return tables ? tables->set : nullptr;
}

}  // namespace cuticle::render::bake_tables
