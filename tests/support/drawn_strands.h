#pragma once
// Strands for tests of ways to draw them, and what brute force makes of them.
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"
#include "gpu/device.h"
#include "gpu/tests/test_device.h"
#include "render/passes/supersampled/rasterise.h"

namespace cuticle::tests {

template <class T>
gpu::Buffer upload(const std::vector<T>& data) {
  return std::move(*gpu::make_buffer_from<T>(*device(), data));
}

inline gpu::Texture target(glm::ivec2 size, gpu::TextureFormat format) {
  return std::move(*device()->make_texture({size, format, gpu::Filter::nearest, 1, true}));
}

/// Strands with their colours, seen by a camera at (0, 0, 4) to whom the square -4 .. 4 at z = 0 fills the picture.
struct Drawing {
  int size = 64;
  double opacity = 1, budget_mib = 96, full_px = 0;
  std::int64_t slices = 0, coverage_rows = 8, lanes = 0;
  std::uint32_t vertices_per_strand = 2;  ///< what chance takes for one
  std::uint32_t segment_parts = 1;        ///< of the segments, so many after each other lie on one line
  std::vector<glm::vec4> vertices, colors;
  std::vector<std::uint32_t> segments;
  float scene_depth = 1;                    ///< of the depth target
  bool has_scene = false, has_gap = false;  ///< a gap: its last column is as far as can be

  Camera camera() const {
    return {.position = {0, 0, 4},
            .target = {0, 0, 0},
            .vertical_field_of_view = std::numbers::pi / 2,
            .near_plane = 0.5,
            .far_plane = 50,
            .resolution = {size, size}};
  }
  float pixel() const { return 8.0f / float(size); }
  void strand(const std::vector<glm::vec3>& points, float radius, const glm::vec3& color) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k > 0) segments.push_back(std::uint32_t(vertices.size() - 1));
      vertices.emplace_back(points[k], radius);
      colors.emplace_back(color, 1);
    }
  }
  Image truth(int samples = 16) const {
    return render::supersampled::rasterise(camera(), {vertices, colors, segments}, {},
                                           {.samples = samples, .opacity = opacity});
  }
};

/// Curved strands of random place, depth, width (0.1 to 1.5 pixels) and colour.
inline Drawing bundle(int strands) {
  Drawing drawing;
  RandomStream random(7);
  const auto number = [&](float least, float most) { return least + (most - least) * float(random.next_unit()); };
  for (int k = 0; k < strands; ++k) {
    const glm::vec3 root(number(-3, 3), number(1, 3.5f), number(-1, 1));
    const glm::vec3 pull(number(-0.5f, 0.5f), number(-1, -0.4f), number(-0.4f, 0.4f));
    const glm::vec3 bend(number(-0.1f, 0.1f), 0, number(-0.1f, 0.1f));
    std::vector<glm::vec3> points;
    for (int v = 0; v < 8; ++v) points.push_back(root + float(v) * pull + float(v * v) * bend);
    const glm::vec3 color(number(0, 1), number(0, 1), number(0, 1));
    drawing.strand(points, 0.5f * number(0.1f, 1.5f) * drawing.pixel(), color);
  }
  return drawing;
}

/// The bundle moved so that the camera stands within it.
inline Drawing around_the_camera() {
  Drawing drawing = bundle(300);
  for (glm::vec4& vertex : drawing.vertices) vertex += glm::vec4(0, -0.8f, 4.6f, 0);
  return drawing;
}

inline double mean_difference(const Image& a, const Image& b, int first_channel, int end_channel) {
  double sum = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = first_channel; c < end_channel; ++c) sum += std::abs(double(a.at(x, y, c) - b.at(x, y, c)));
  return sum / (a.width * a.height * (end_channel - first_channel));
}

}  // namespace cuticle::tests
