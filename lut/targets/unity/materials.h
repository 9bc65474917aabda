#pragma once
// Hair materials of Unity's two render pipelines that shade with the tables.

namespace cuticle::lut::unity {

extern const char* const k_urp_material;   ///< with @VERSION@ and @PROPERTIES@
extern const char* const k_hdrp_material;  ///< the same
extern const char* const k_readme;         ///< with @VERSION@, @MODEL@ and @TABLES@

}  // namespace cuticle::lut::unity
