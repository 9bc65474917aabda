#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::nalu {

const Layout& entry() {
  static const Layout layout{
      .entry =
          nalu_entry("nalu", "three textures: M and cos theta_d; N_TT and N_R; N_TRT; end points on texel centres"),
      .tables = k_nalu_tables<SineAxes<true>>,
      .composition = k_three_textures,
      .terms = k_nalu_terms,
      .family = "nalu"};
  return layout;
}

}  // namespace cuticle::lut::nalu
