#include "shadows/method_gpu.h"

#include <fmt/core.h>

namespace cuticle::shadows {

Result<const GpuMethod*> find_gpu_method(std::string_view name) {
  for (const GpuMethod* method : gpu_methods())
    if (method->name == name) return method;
  return usage_error(fmt::format("shadow method '{}' has no GPU half", name), "opacity_map");
}

}  // namespace cuticle::shadows
