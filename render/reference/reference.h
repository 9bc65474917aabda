#pragma once
// A picture by path tracing, sample by sample until it is good enough.
#include <span>
#include <vector>

#include "render/reference/film.h"

namespace cuticle::render::reference {

struct Quality {
  int samples = 64;      ///< of a pixel, at most
  double max_error = 0;  ///< of a tile's pixels, root mean square, over the tile's mean or a twentieth of the picture's
                         ///< largest; 0: all samples are drawn
  std::string state = {};  ///< file of the sums; empty: none. An existing one is gone on from
  double save_seconds = 30;
};

struct Picture {
  Image color, layers;            ///< layers: as Film's
  std::vector<SeenShare> shares;  ///< with TraceOptions::strands, as Film's
  int samples = 0;                ///< most of a pixel
  double error = 0;    ///< standard error of a pixel, root mean square over the tiles that hold light, over their mean
  double seconds = 0;  ///< of its paths; what is made ready before (ray tree, tables, shadow maps) is left out
  double processor_seconds = 0;  ///< the same, of all threads
};

/// What names a picture for its state file: scene, options, seed.
std::uint64_t key_of(const TracedScene& scene, const TraceOptions& options);

/// Renders in rounds of 8 samples over tiles of 16 x 16 pixels, on all threads; the same bits for any number of them,
/// and where it was stopped and gone on from its state. Tiles whose error is met rest. Test: reference_test.cpp.
/// Errors: those of Tracer and Film.
Result<Picture> trace_picture(const TracedScene& scene, const TraceOptions& options, const Quality& quality,
                              Progress& progress);
/// The same with each of these seeds in turn, bit for bit as trace_picture draws them; the scene is made
/// ready once.
/// No state. Test: reference_test.cpp. Errors: those of trace_picture.
Result<std::vector<Picture>> trace_pictures(const TracedScene& scene, const TraceOptions& options,
                                            const Quality& quality, std::span<const std::uint64_t> seeds,
                                            Progress& progress);

}  // namespace cuticle::render::reference
