#include "core/image/text.h"

#include <algorithm>
#include <array>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace cuticle {
namespace {

/// What stb_easy_font writes for each corner of a rectangle.
struct Corner {
  float x, y, z;
  unsigned char color[4];
};
using Rectangle = std::array<Corner, 4>;

void fill(Image& image, int x0, int y0, int x1, int y1, float value) {
  for (int y = std::max(y0, 0); y < std::min(y1, image.height); ++y)
    for (int x = std::max(x0, 0); x < std::min(x1, image.width); ++x)
      for (int c = 0; c < image.channels(); ++c) image.at(x, y, c) = value;
}

}  // namespace

int text_width(const std::string& line) { return stb_easy_font_width(std::string(line).data()); }

void draw_text(Image& image, int x, int y, const std::string& line, float value, int scale) {
  std::vector<Rectangle> rectangles(64 * line.size() + 1);
  std::string text = line;
  const int count = stb_easy_font_print(0, 0, text.data(), nullptr, rectangles.data(),
                                        int(rectangles.size() * sizeof(Rectangle)));
  for (int i = 0; i < count; ++i) {
    const Corner &first = rectangles[std::size_t(i)][0], &last = rectangles[std::size_t(i)][2];
    fill(image, x + scale * int(first.x), y + scale * int(first.y), x + scale * int(last.x), y + scale * int(last.y),
         value);
  }
}

}  // namespace cuticle
