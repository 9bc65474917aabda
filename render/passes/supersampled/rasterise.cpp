#include "render/passes/supersampled/rasterise.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace cuticle::render::supersampled {

namespace {

constexpr int k_tile = 8;  // pixels each way

/// A segment on the screen, pixels. `inverse` is 1 / distance along the view; colours are times it, so that both are
/// linear on the screen.
struct Line {
  glm::dvec2 from, along;
  double per_length_squared = 0;
  glm::dvec2 half_width, inverse;  ///< at the two ends
  glm::dvec3 color_from, color_to;
  std::uint32_t vertex = 0;
};

struct Hit {
  double inverse, share;
  const Line* line;
};

bool is_finite(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

/// Sums over samples; depth times what is seen.
struct SeenStrand {
  glm::dvec4 light{0};
  double depth = 0;
};

class Projection {
 public:
  explicit Projection(const Camera& camera)
      : view_(view_matrix(camera)),
        resolution_(camera.resolution),
        near_(camera.near_plane),
        far_(camera.far_plane),
        scale_(camera.resolution.y / (2 * std::tan(camera.vertical_field_of_view / 2))) {}

  /// False where nothing of it lies between the near and the far plane.
  bool line(const ColoredStrands& strands, std::uint32_t vertex, Line& line) const {
    const glm::vec4 &a = strands.vertices[vertex], &b = strands.vertices[vertex + 1];
    if (!is_finite(a) || !is_finite(b) || !(strands.colors[vertex + 1].w > 0)) return false;
    const glm::dvec3 p(view_ * glm::dvec4(glm::dvec3(a), 1)), q(view_ * glm::dvec4(glm::dvec3(b), 1));
    double first = 0, last = 1;
    cut(-p.z - near_, -q.z - near_, first, last);
    cut(far_ + p.z, far_ + q.z, first, last);
    if (!(first < last)) return false;
    const glm::dvec3 from = glm::mix(p, q, first), to = glm::mix(p, q, last);
    line.from = on_screen(from);
    line.along = on_screen(to) - line.from;
    const double squared = glm::dot(line.along, line.along);
    line.per_length_squared = squared > 0 ? 1 / squared : 0;
    line.inverse = {-1 / from.z, -1 / to.z};
    line.half_width = scale_ * line.inverse * glm::mix(glm::dvec2(a.w), glm::dvec2(b.w), glm::dvec2(first, last));
    const glm::dvec3 root(strands.colors[vertex]), tip(strands.colors[vertex + 1]);
    line.color_from = glm::mix(root, tip, first) * line.inverse.x;
    line.color_to = glm::mix(root, tip, last) * line.inverse.y;
    line.vertex = vertex;
    return std::max(line.half_width.x, line.half_width.y) > 0;
  }

 private:
  static void cut(double at_0, double at_1, double& first, double& last) {
    if (at_0 < 0) first = at_1 < 0 ? 2 : std::max(first, at_0 / (at_0 - at_1));
    if (at_1 < 0 && at_0 >= 0) last = std::min(last, at_0 / (at_0 - at_1));
  }
  glm::dvec2 on_screen(const glm::dvec3& p) const {
    return 0.5 * glm::dvec2(resolution_) + glm::dvec2(p.x, -p.y) * (scale_ / -p.z);
  }

  glm::dmat4 view_;
  glm::ivec2 resolution_;
  double near_, far_, scale_;
};

double widest(const Line& line) { return std::max(line.half_width.x, line.half_width.y); }

/// Share of the way from end to end that is nearest to a point.
double nearest_share(const Line& line, const glm::dvec2& point) {
  return std::clamp(glm::dot(point - line.from, line.along) * line.per_length_squared, 0.0, 1.0);
}

bool within(const Line& line, const glm::dvec2& point, double share, double half_width) {
  const glm::dvec2 apart = point - line.from - share * line.along;
  return glm::dot(apart, apart) <= half_width * half_width;
}

double inverse_at(const Line& line, double share) { return glm::mix(line.inverse.x, line.inverse.y, share); }

/// Lines that may cover each tile.
class Tiles {
 public:
  Tiles(const std::vector<Line>& lines, glm::ivec2 resolution)
      : grid_((resolution + k_tile - 1) / k_tile), lists_(std::size_t(grid_.x) * std::size_t(grid_.y)) {
    for (const Line& line : lines) add(line);
  }
  std::size_t count() const { return lists_.size(); }
  glm::ivec2 corner(std::size_t tile) const { return k_tile * glm::ivec2(int(tile) % grid_.x, int(tile) / grid_.x); }
  const std::vector<const Line*>& lines(std::size_t tile) const { return lists_[tile]; }

 private:
  void add(const Line& line) {
    const glm::dvec2 to = line.from + line.along;
    const glm::ivec2 least = tile_at(glm::min(line.from, to) - widest(line), 0),
                     most = tile_at(glm::max(line.from, to) + widest(line), -1);
    for (int y = least.y; y <= most.y; ++y)
      for (int x = least.x; x <= most.x; ++x) {
        const glm::dvec2 middle = (glm::dvec2(x, y) + 0.5) * double(k_tile);
        if (within(line, middle, nearest_share(line, middle), widest(line) + k_tile * std::sqrt(0.5)))
          lists_[std::size_t(y) * std::size_t(grid_.x) + std::size_t(x)].push_back(&line);
      }
  }
  /// Limited to the grid; `beyond`: 0 for the first tile of a range, -1 for the last.
  glm::ivec2 tile_at(const glm::dvec2& point, int beyond) const {
    const glm::dvec2 limited = glm::clamp(point / double(k_tile), glm::dvec2(-1), glm::dvec2(grid_) + 1.0);
    const glm::ivec2 tile(glm::floor(limited));
    return beyond == 0 ? glm::max(tile, 0) : glm::min(tile, grid_ - 1);
  }

  glm::ivec2 grid_;
  std::vector<std::vector<const Line*>> lists_;
};

/// Whether the same strand's neighbouring segment was counted already: a joint.
bool is_joint(const std::vector<Hit>& hits, std::size_t count, const Line& line) {
  for (std::size_t k = 0; k < count; ++k)
    if (hits[k].line->vertex + 1 == line.vertex || line.vertex + 1 == hits[k].line->vertex) return true;
  return false;
}

/// Where each row's samples lie between its strata, in their widths, and each column's: as many places as there are
/// rows, neighbours far apart. All n x n samples then lie on distances of their own from an edge along an axis of the
/// picture; a plain grid has n, and hair thinner than they are apart covers whole columns or nothing.
std::vector<double> shifts(int n) {
  int step = std::max(1, int(std::lround(0.618034 * n)));  // the golden ratio's
  while (std::gcd(step, n) > 1) ++step;
  std::vector<double> places;
  for (int k = 0; k < n; ++k) places.push_back((k * step % n + 0.5) / n);
  return places;
}

class Sampler {
 public:
  /// `vertices_per_strand`: strands are told apart; 0: they are not.
  Sampler(const Camera& camera, const OpaqueScene& scene, const Sampling& sampling, std::uint32_t vertices_per_strand)
      : scene_(scene),
        sampling_(sampling),
        shifts_(shifts(sampling.samples)),
        width_(camera.resolution.x),
        inverse_near_(1 / camera.near_plane),
        inverse_far_(1 / camera.far_plane),
        vertices_per_strand_(vertices_per_strand) {}

  /// Of the pixel before.
  void append_seen(glm::ivec2 pixel, std::vector<SeenShare>& shares) {
    const double samples = double(sampling_.samples) * sampling_.samples;
    for (auto& [strand, seen] : seen_)
      shares.push_back({std::uint32_t(pixel.y) * std::uint32_t(width_) + std::uint32_t(pixel.x), strand,
                        float(seen.depth / seen.light.w), glm::vec4(seen.light / samples)});
  }

  glm::dvec4 pixel(glm::ivec2 pixel, const std::vector<const Line*>& of_tile) {
    gather(pixel, of_tile);
    seen_.clear();
    if (lines_.empty() && scene_.color.empty()) return glm::dvec4(0);
    glm::dvec4 sum(0);
    const int n = sampling_.samples;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        sum += sample(pixel,
                      (glm::dvec2(x, y) + glm::dvec2(shifts_[std::size_t(y)], shifts_[std::size_t(x)])) / double(n));
    return sum / double(n * n);
  }

 private:
  void gather(glm::ivec2 pixel, const std::vector<const Line*>& of_tile) {
    const glm::dvec2 middle = glm::dvec2(pixel) + 0.5;
    lines_.clear();
    for (const Line* line : of_tile)
      if (within(*line, middle, nearest_share(*line, middle), widest(*line) + std::sqrt(0.5))) lines_.push_back(line);
  }

  /// From near to far; of equal depths the first vertex first.
  void find_hits(const glm::dvec2& point, double farthest) {
    hits_.clear();
    for (const Line* line : lines_) {
      const double share = nearest_share(*line, point), inverse = inverse_at(*line, share);
      if (inverse >= farthest && within(*line, point, share, glm::mix(line->half_width.x, line->half_width.y, share)))
        hits_.push_back({inverse, share, line});
    }
    std::ranges::sort(hits_, [](const Hit& a, const Hit& b) {
      return a.inverse > b.inverse || (a.inverse == b.inverse && a.line->vertex < b.line->vertex);
    });
  }

  glm::dvec4 sample(glm::ivec2 pixel, const glm::dvec2& inside) {
    const std::size_t texel = texel_at(pixel, inside);
    const double farthest =
        scene_.depth.empty() ? 0 : glm::mix(inverse_near_, inverse_far_, double(scene_.depth[texel]));
    find_hits(glm::dvec2(pixel) + inside, farthest);
    glm::dvec4 result(0);
    double through = 1;
    for (std::size_t k = 0; k < hits_.size() && through > 0; ++k) {
      const Hit& hit = hits_[k];
      if (sampling_.opacity < 1 && is_joint(hits_, k, *hit.line)) continue;
      const glm::dvec3 color = glm::mix(hit.line->color_from, hit.line->color_to, hit.share) / hit.inverse;
      const glm::dvec4 light = through * sampling_.opacity * glm::dvec4(color, 1);
      result += light;
      if (vertices_per_strand_ > 0) note_seen(hit, light);
      through *= 1 - sampling_.opacity;
    }
    for (int c = 0; c < 4 && !scene_.color.empty(); ++c)
      result[c] += through * double(scene_.color[4 * texel + std::size_t(c)]);
    return result;
  }

  void note_seen(const Hit& hit, const glm::dvec4& light) {
    const std::uint32_t strand = hit.line->vertex / vertices_per_strand_ + 1;
    auto found = std::ranges::find(seen_, strand, &std::pair<std::uint32_t, SeenStrand>::first);
    if (found == seen_.end()) found = seen_.insert(found, {strand, SeenStrand()});
    found->second.light += light;
    found->second.depth += light.w / hit.inverse;
  }

  std::size_t texel_at(glm::ivec2 pixel, const glm::dvec2& inside) const {
    const glm::ivec2 texel = pixel * scene_.supersampling + glm::ivec2(inside * double(scene_.supersampling));
    return std::size_t(texel.y) * std::size_t(width_ * scene_.supersampling) + std::size_t(texel.x);
  }

  const OpaqueScene& scene_;
  const Sampling& sampling_;
  std::vector<double> shifts_;
  int width_;
  double inverse_near_, inverse_far_;
  std::uint32_t vertices_per_strand_;
  std::vector<const Line*> lines_;
  std::vector<Hit> hits_;
  std::vector<std::pair<std::uint32_t, SeenStrand>> seen_;
};

std::vector<Line> lines_of(const Camera& camera, const ColoredStrands& strands) {
  const Projection projection(camera);
  std::vector<Line> lines;
  Line line;
  for (std::uint32_t vertex : strands.segments)
    if (projection.line(strands, vertex, line)) lines.push_back(line);
  return lines;
}

/// Adds to `shares` what the tile's pixels see of each strand, where the sampler tells them apart.
void draw_tile(const Tiles& tiles, std::size_t tile, Sampler& sampler, Image& image, std::vector<SeenShare>& shares) {
  const glm::ivec2 corner = tiles.corner(tile);
  for (int y = corner.y; y < std::min(corner.y + k_tile, image.height); ++y)
    for (int x = corner.x; x < std::min(corner.x + k_tile, image.width); ++x) {
      const glm::dvec4 color = sampler.pixel({x, y}, tiles.lines(tile));
      for (int c = 0; c < 4; ++c) image.at(x, y, c) = float(color[c]);
      sampler.append_seen({x, y}, shares);
    }
}

}  // namespace

ToldImage rasterise_told(const Camera& camera, const ColoredStrands& strands, const OpaqueScene& scene,
                         const Sampling& sampling, std::uint32_t vertices_per_strand) {
  const std::vector<Line> lines = lines_of(camera, strands);
  const Tiles tiles(lines, camera.resolution);
  ToldImage told{make_image(camera.resolution.x, camera.resolution.y, {"R", "G", "B", "A"}), {}};
  std::vector<std::vector<SeenShare>> of_tiles(tiles.count());
  tbb::parallel_for(std::size_t(0), tiles.count(), [&](std::size_t tile) {
    Sampler sampler(camera, scene, sampling, vertices_per_strand);
    draw_tile(tiles, tile, sampler, told.image, of_tiles[tile]);
  });
  for (const std::vector<SeenShare>& each : of_tiles) told.shares.insert(told.shares.end(), each.begin(), each.end());
  return told;
}

Image rasterise(const Camera& camera, const ColoredStrands& strands, const OpaqueScene& scene,
                const Sampling& sampling) {
  return rasterise_told(camera, strands, scene, sampling, 0).image;
}

std::vector<float> behind(const Camera& camera, const OpaqueScene& scene) {
  std::vector<float> distances;
  const std::size_t texels = std::size_t(scene.supersampling), row = texels * std::size_t(camera.resolution.x);
  for (int y = 0; !scene.depth.empty() && y < camera.resolution.y; ++y)
    for (int x = 0; x < camera.resolution.x; ++x) {
      const double depth =
          double(scene.depth[(std::size_t(y) * texels + texels / 2) * row + std::size_t(x) * texels + texels / 2]);
      const double inverse = glm::mix(1 / camera.near_plane, 1 / camera.far_plane, depth);
      distances.push_back(depth < 1 ? float(1 / inverse) : 0.0F);
    }
  return distances;
}

}  // namespace cuticle::render::supersampled
