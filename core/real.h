#pragma once
// The precision of batch work: float, or double in the preset `double`, which shows what single precision costs.

namespace cuticle {

#ifdef CUTICLE_SINGLE_IS_DOUBLE
using Single = double;
#else
using Single = float;
#endif

}  // namespace cuticle
