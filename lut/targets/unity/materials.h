#pragma once
// Hair materials of Unity's two render pipelines that shade with the tables.
#include <string>

namespace cuticle::lut::unity {

std::string urp_material();         ///< with @VERSION@ and @PROPERTIES@
std::string hdrp_material();        ///< the same
extern const char* const k_readme;  ///< with @VERSION@, @MODEL@ and @TABLES@

}  // namespace cuticle::lut::unity
