#include "render/resources_gpu.h"

#include <algorithm>

#include <fmt/core.h>

#include "render/pass_gpu.h"

namespace cuticle::render {

Resources::Resources() {
  put(FrameView{});
  put(Lights{});
  put(FibreMaterial{});
  put(FibreOpacity{});
  put(Surfaces{});
  put(DrawnHair{});
  put(Targets{});
  put(StrandDraw{});
}

void Resources::note_use(std::string_view resource) const {
  if (user_.empty() || std::ranges::find(uses_, resource, &Use::resource) != uses_.end()) return;
  undeclared_.insert(fmt::format("the pass '{}' uses '{}' without declaring it", user_, resource));
}

}  // namespace cuticle::render
