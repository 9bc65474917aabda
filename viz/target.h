#pragma once
// Where a view goes. Needs no VTK.
#include <string>

#include <glm/vec2.hpp>

namespace cuticle::viz {

/// A PNG file, a movie, both, or (neither) a window until it is closed.
struct ViewTarget {
  std::string screenshot = {};  ///< FILE.png
  /// FILE.ogv (Theora), or a folder for numbered PNG files: a run's frames, or with `turntable` a turn about the view.
  std::string movie = {};
  bool turntable = false;      ///< the movie turns the view once, also where it shows a run
  int turn_frames = 120;       ///< of a whole turn
  int frames_per_second = 24;  ///< of the movie
  glm::ivec2 size{1400, 900};
  std::string export_folder = {};  ///< where the key x of a window writes what is shown; empty: view_export
  bool is_window() const { return screenshot.empty() && movie.empty(); }
};

}  // namespace cuticle::viz
