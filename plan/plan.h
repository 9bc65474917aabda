#pragma once
// From a scene's facts to the passes that they demand, each with its reason.
#include <string>
#include <vector>

#include "core/registry/entry.h"
#include "render/resource.h"
#include "scene/scene.h"

namespace cuticle::plan {

/// Every registered model, layout, method, effect and pass.
const scene::Catalogue& catalogue();

struct PlannedPass {
  const registry::Entry* entry = nullptr;
  std::string reason;
  std::uint32_t dispatches = 0, draws = 0;  ///< per frame
  bool on_cpu = false;                      ///< runs on the CPU, and dispatches nothing
};
/// A resource that some pass of the plan, or the scene, asks for.
struct PlannedResource {
  std::string_view name;
  std::vector<const registry::Entry*> writers,
      readers;  ///< in the order in which they run; no writer: the scene gives it
};
struct LeftOut {
  const registry::Entry* entry = nullptr;
  std::string reason;
};
/// What a plan asks about the device that will run it.
struct DeviceTraits {
  std::string name = {};
  bool is_software = false;  ///< its kernels run on the same cores as the CPU's code
};
struct Plan {
  registry::Facts facts;
  registry::FrameShape shape;
  std::vector<PlannedPass> passes;  ///< in the order in which they run
  std::vector<LeftOut> left_out;
  std::vector<std::string_view> outputs = {};   ///< resources that the scene asks for, as files have them
  std::vector<PlannedResource> resources = {};  ///< by name
};

/// The facts of a scene: "light", "shadow_method", "motion", "simulation", "colliders", "head", "strands",
/// "output_color", ...
registry::Facts facts_of(const scene::Scene& scene);
/// `shape` of the frame as built (strands loaded or grown). Hair is solved by the CPU's code where the scene says so
/// or, left to choose ("auto"), where the device is software: there the kernels take 44 to 72 times as long
/// (sim/README.md).
Plan make_plan(const scene::Scene& scene, const registry::FrameShape& shape, const DeviceTraits& device = {});
/// What an entry reads and writes of a frame; empty: it is no pass of the picture, as solvers and effects.
std::span<const render::Use> uses_of(const registry::Entry& entry);
/// The planned pass of that name, or null.
const PlannedPass* find_pass(const Plan& plan, std::string_view name);
std::string to_text(const Plan& plan);
std::string to_json(const Plan& plan);

}  // namespace cuticle::plan
