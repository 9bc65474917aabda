#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::nalu_borders {

const Layout& entry() {
  static const Layout layout{
      .entry = nalu_entry("nalu_borders",
                          "as nalu, end points on texel borders: the sine or cosine itself addresses the table"),
      .tables = k_nalu_tables<SineAxes<false>>,
      .composition = k_three_textures,
      .terms = k_nalu_terms,
      .family = "nalu"};
  return layout;
}

}  // namespace cuticle::lut::nalu_borders
