#pragma once
// Sums of a picture's samples: mean, variance, layers; kept in a file so that a render can go on later.
#include <span>
#include <string>
#include <vector>

#include "core/image/deep.h"
#include "render/reference/tracer.h"

namespace cuticle::render::reference {

class Film {
 public:
  /// `lobes`: names of the splits (split_names); empty: no layers are kept. `strands`: so is what is seen of each.
  Film(glm::ivec2 size, std::vector<std::string> split_names, bool strands = false);

  /// Adds a pixel's samples, in their order; `splits`: with layers.
  void add(std::uint32_t pixel, const PathLight& light, const LightSplits* splits = nullptr);
  std::uint32_t samples(std::uint32_t pixel) const { return pixels_[pixel].samples; }
  glm::ivec2 size() const { return size_; }
  bool has_layers() const { return !names_.empty(); }

  /// Mean radiance of the pixels [first, first + count) of a list, and the root mean square of their standard errors;
  /// luminances.
  struct Noise {
    double mean = 0, standard_error = 0;
  };
  Noise noise(std::span<const std::uint32_t> pixels) const;

  /// R, G, B (premultiplied by coverage), A.
  Image color() const;
  /// The colour, then `variance.R/G/B` (of the pixel's mean), `samples.Y`, and with layers `coverage.Y`, `depth.Z`,
  /// `tangent.X/Y/Z`, `strand.id` (of the first sample that sees hair) and the splits.
  Image layers() const;

  /// What each pixel sees of each strand (objects from 1) and beside them (0); light and shares add up to the colour.
  std::vector<SeenShare> shares() const;

  /// All sums, for a render that is the same by `key`. Error: of the file system.
  Result<void> save(const std::string& path, std::uint64_t key) const;
  /// False: there is no such file. Errors: bad_input, where it is not such a file, is cut short, or is of another
  /// scene, size, seed or choice of layers.
  Result<bool> load(const std::string& path, std::uint64_t key);

 private:
  struct Pixel {
    glm::dvec3 sum{0}, squares{0};
    std::uint32_t samples = 0, covered = 0;
  };
  struct SeenStrand;
  static void note_seen(std::vector<SeenStrand>& seen, const PathLight& light);
  struct Header;
  Header header(std::uint64_t key) const;

  glm::ivec2 size_;
  std::vector<std::string> names_;
  std::vector<Pixel> pixels_;
  std::vector<SeenFirst> first_;   ///< with layers
  std::vector<glm::vec3> splits_;  ///< sums, `k_splits` a pixel, with layers
  /// Sums over the samples that see a strand first; few a pixel, so that a list is searched.
  struct SeenStrand {
    std::uint32_t strand = 0;
    double depth = 0;
    glm::dvec4 light{0};
  };
  std::vector<std::vector<SeenStrand>> seen_;  ///< of each pixel, where strands are told apart
};

}  // namespace cuticle::render::reference
