#include <dlfcn.h>
#include <fmt/format.h>

#include "viz/views.h"

namespace cuticle::viz {

Result<const Views*> load_views() {
  constexpr const char* name = "libcuticle_views.so";
  void* const library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  if (!library)
    return Error{ErrorKind::no_device, fmt::format("views need VTK: {}", dlerror()),
                 "install libvtk9.1 (Debian) and build with it, or take --export DIR, which needs no VTK"};
  const auto entry = reinterpret_cast<const Views* (*)()>(dlsym(library, "cuticle_views"));
  if (!entry) return internal_error(fmt::format("{}: {}", name, dlerror()));
  return entry();
}

}  // namespace cuticle::viz
