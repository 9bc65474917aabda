#include "shadows/method_gpu.h"

#include <fmt/core.h>

namespace cuticle::shadows {

Result<void> GpuShadow::record_fragments(gpu::Commands&, const GpuStrands&, const LightSource&, const FragmentTarget&) {
  return usage_error("this setting of the shadow method has no lookup between vertices",
                     "method opacity_map with form=graphics_8bit or graphics_half");
}

Result<const GpuMethod*> find_gpu_method(std::string_view name) {
  for (const GpuMethod* method : gpu_methods())
    if (method->name == name) return method;
  return usage_error(fmt::format("shadow method '{}' has no GPU half", name), "opacity_map");
}

}  // namespace cuticle::shadows
