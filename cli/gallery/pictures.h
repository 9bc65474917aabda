#pragma once
// The pictures of `cuticle gallery` (docs/gallery.md): each is made by commands of this program.
#include <span>
#include <string_view>
#include <vector>

namespace cuticle::cli {

struct GalleryPicture {
  std::string_view name, title;
  /// Arguments of `cuticle`. {work} is a folder of the picture's own, {scenes} that of the scenes; {440} is 440 times
  /// the gallery's scale.
  std::vector<std::string_view> commands;
  std::vector<std::string_view> parts;  ///< pictures in {work}, side by side
  int columns = 1;                      ///< parts in a row
  int samples = 1;                      ///< pixels of a part along each side of one of the picture
  bool needs_data = false;              ///< the test data's, CUTICLE_TEST_DATA
  bool needs_display = false;           ///< VTK and a display, or xvfb-run
};

std::span<const GalleryPicture> gallery_pictures();

}  // namespace cuticle::cli
