#include <cuticle/lut/layouts/nalu_channels.h>

namespace cuticle::lut::nalu {

const Layout& entry() {
  static const Layout layout{
      nalu_entry("nalu", "three textures: M and cos theta_d; N_TT and N_R; N_TRT; end points on texel centres"),
      k_nalu_tables<true>, k_three_textures};
  return layout;
}

}  // namespace cuticle::lut::nalu
