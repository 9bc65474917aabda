#pragma once
// Strands to pixels by brute force: what the faster ways are measured against.
#include <cstdint>
#include <span>

#include <glm/vec4.hpp>

#include "core/image/deep.h"
#include "core/view.h"

namespace cuticle::render::supersampled {

/// Segments join vertices k and k + 1. A segment is drawn where the w of its second vertex's colour is positive and its
/// four ends' numbers are finite.
struct ColoredStrands {
  std::span<const glm::vec4> vertices;      ///< position and radius, metres
  std::span<const glm::vec4> colors;        ///< radiance, and 1 where the strand is kept
  std::span<const std::uint32_t> segments;  ///< first vertices
};

/// What stands between the strands: its supersampled picture and depth, row by row. Empty: nothing.
struct OpaqueScene {
  std::span<const float> color;  ///< four per texel, premultiplied by coverage
  std::span<const float> depth;  ///< one per texel, as in the depth target: 0 near .. 1 far
  int supersampling = 1;         ///< texels across a pixel
};

struct Sampling {
  int samples = 16;    ///< along each side of a pixel
  double opacity = 1;  ///< of a strand where it covers a sample
};

/// The picture (R, G, B, A; premultiplied by coverage) by samples x samples points in each pixel, one in each square of
/// a grid, all of them in rows and columns of their own: at each, all strands that cover it, sorted by depth,
/// composited from near to far, then the scene. A strand is a cone between its vertices with round joints, seen as its
/// silhouette; segments that follow each other on a strand count once where they overlap; colour and depth are
/// interpolated as seen in perspective. Cut at the near and far planes. Between the samples of an edge coverage errs by
/// at most about 1 / samples per edge that crosses the pixel (rasterise_test).
Image rasterise(const Camera& camera, const ColoredStrands& strands, const OpaqueScene& scene,
                const Sampling& sampling);

/// A picture, and what each pixel of it sees of each strand.
struct ToldImage {
  Image image;
  std::vector<SeenShare> shares;
};
/// The picture with its samples told apart by strand, strands from 1 by their `vertices_per_strand` vertices. Light and
/// shares add up to the picture's hair.
ToldImage rasterise_told(const Camera& camera, const ColoredStrands& strands, const OpaqueScene& scene,
                         const Sampling& sampling, std::uint32_t vertices_per_strand);

/// How far the scene stands in the middle of each pixel, metres along the view; 0: nothing there.
std::vector<float> behind(const Camera& camera, const OpaqueScene& scene);

}  // namespace cuticle::render::supersampled
