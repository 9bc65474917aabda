// The entry of the loaded module.
#include "viz/lobes/lobes_view.h"
#include "viz/views.h"

extern "C" const cuticle::viz::Views* cuticle_views() {
  using namespace cuticle::viz;
  static const Views views{.lobes = [](const LobesView& view, const ViewTarget& target) -> cuticle::Result<void> {
    LobesPicture picture(view);
    return present(picture, target);
  }};
  return &views;
}
