#pragma once
// What each pixel sees of each strand, by the fine rasteriser.
#include <span>
#include <vector>

#include "core/image/deep.h"
#include "gpu/device.h"
#include "render/passes/tiles/fine_gpu.h"

namespace cuticle::render::tiles {

/// Draws the lists once more and keeps a record of each segment that a pixel sees, band by band of the picture where
/// they do not fit into one buffer. `bound`: bindings 0 .. 7 of tiles.comp. Shares and light add up to what `tiles`
/// left. Test: seen_shares_gpu_test. Errors: of the device.
Result<std::vector<SeenShare>> shares_of_tiles(gpu::Device& device, const FineForm& form,
                                               std::vector<const gpu::Buffer*> bound, const tile_lists::TilePush& push,
                                               glm::uvec2 grid);

}  // namespace cuticle::render::tiles
