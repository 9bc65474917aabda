// What a picture brings from the device.
#include <algorithm>

#include "plan/picture_gpu.h"
#include "plan/picture_layers_gpu.h"

namespace cuticle::plan {

Result<Image> Picture::read_color() const {
  for (const DrawnPass& drawn : passes_) {
    CUTICLE_ASSIGN(std::optional<Image> finished, drawn.pass->finish(resources_));
    if (finished) return std::move(*finished);
  }
  if (in_chunks()) return chunks_;
  Image image = make_image(output_.size().x, output_.size().y, {"R", "G", "B", "A"});
  CUTICLE_ASSIGN(image.pixels, device_->download(output_));
  return image;
}

Result<Image> Picture::read_aovs(const Image& color) const {
  Image image;
  for (const std::string_view wanted : plan_.outputs)
    for (const DrawnPass& drawn : passes_) {
      const std::optional<render::FileLayer> layer = drawn.pass->layer(wanted, resources_);
      if (!layer) continue;
      CUTICLE_ASSIGN(image,
                     with_channels(*device_, image.pixels.empty() ? color : image, *layer->values, layer->channels));
    }
  return image;
}

Result<ToldPicture> Picture::read_told() const {
  std::optional<render::SeenStrands> seen;
  for (const DrawnPass& drawn : passes_) {
    CUTICLE_ASSIGN(seen, drawn.pass->seen_strands(resources_));
    if (seen) break;
  }
  CUTICLE_EXPECT(seen, "check_told_strands refuses ways of drawing that cannot tell");
  ToldPicture told;
  CUTICLE_ASSIGN(told.color, read_color());
  told.shares = with_rest(std::move(seen->shares), told.color, seen->behind,
                          resources_.get<render::FrameView>().camera.far_plane);
  return told;
}

Result<strands::Groom> Picture::read_strands() const {
  const std::size_t count = generator_->vertex_count();
  CUTICLE_ASSIGN(const auto vertices, gpu::read_buffer<glm::vec4>(*device_, generator_->vertices(), count));
  const bool as_given = scene::draws_as_given(scene_);
  const std::size_t row = generator_->vertices_per_strand();
  strands::Groom groom;
  for (std::size_t s = 0; s < generator_->strand_count(); ++s) {
    const std::size_t size = as_given ? set_.control.strand_size(set_.placed[s].guide) : row;
    for (std::size_t k = 0; k < size; ++k) {  // not the ends of parts between a segment's ends
      const glm::vec4& vertex = vertices[s * row + k * set_.segment_parts];
      groom.positions.emplace_back(vertex);
      groom.radii.push_back(vertex.w);
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  return groom;
}

}  // namespace cuticle::plan
