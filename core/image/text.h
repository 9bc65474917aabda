#pragma once
// Words in pictures.
#include <string>

#include "core/image/image.h"

namespace cuticle {

/// Height of a line of text in pixels, at scale 1.
inline constexpr int k_text_height = 12;
/// Width in pixels at scale 1 of one line of ASCII.
int text_width(const std::string& line);
/// Draws a line of ASCII in one value for all channels, its top left corner at (x, y); what lies outside is cut.
void draw_text(Image& image, int x, int y, const std::string& line, float value, int scale = 1);

}  // namespace cuticle
