#pragma once
// The views that VTK draws, as a table: they are a module of their own, which is loaded when a view is asked for, so
// that all else runs where VTK is missing.
#include <string>

#include "viz/lobes/lobes.h"
#include "viz/lobes/paths.h"
#include "viz/plan/plan.h"
#include "viz/shadow/shadow.h"
#include "viz/strands/states.h"
#include "viz/tables/tables.h"
#include "viz/target.h"

namespace cuticle::viz {

struct Views {
  Result<void> (*lobes)(const LobesView&, const ViewTarget&) = nullptr;
  Result<void> (*paths)(const PathsView&, const ViewTarget&) = nullptr;
  Result<void> (*tables)(const TablesView&, const ViewTarget&) = nullptr;
  Result<void> (*strands)(const StrandsView&, const ViewTarget&) = nullptr;
  Result<void> (*shadow)(const ShadowView&, const ViewTarget&) = nullptr;
  Result<void> (*plan)(const PlanView&, const ViewTarget&) = nullptr;
};
/// Loads libcuticle_views.so. Error: no_device where it, or a library that it needs, is not there.
Result<const Views*> load_views();

}  // namespace cuticle::viz
