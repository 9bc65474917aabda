#pragma once
// The views that VTK draws, as a table: they are a module of their own, which is loaded when a view is asked for, so that
// all else runs where VTK is missing.
#include <string>

#include "viz/lobes/lobes.h"
#include "viz/target.h"

namespace cuticle::viz {

struct Views {
  Result<void> (*lobes)(const LobesView&, const ViewTarget&) = nullptr;
};
/// Loads libcuticle_views.so. Error: no_device where it, or a library that it needs, is not there.
Result<const Views*> load_views();

}  // namespace cuticle::viz
