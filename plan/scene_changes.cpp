#include "plan/scene_changes.h"

#include <algorithm>
#include <iterator>

#include <fmt/core.h>

namespace cuticle::plan {

namespace {

using scene::Scene;

registry::ParameterValues defaults(const registry::Entry& entry) { return registry::default_values(entry.parameters); }

void add_registered(std::vector<SceneChange>& changes) {
  for (const registry::Entry* entry : catalogue().methods)
    changes.push_back({fmt::format("\"shadow\": {{\"method\": {{\"{}\": {{}}}}}}", entry->name), [entry](Scene& scene) {
                         scene.shadow = {std::string(entry->name), defaults(*entry)};
                       }});
  for (const registry::Entry* entry : catalogue().solvers)
    changes.push_back(
        {fmt::format("\"simulation\": {{\"solver\": {{\"{}\": {{}}}}}}", entry->name), [entry](Scene& scene) {
           scene.simulation.solver = {std::string(entry->name), defaults(*entry)};
         }});
  for (const registry::Entry* entry : catalogue().effects)
    changes.push_back({fmt::format("simulation.effects: \"{}\": {{}}", entry->name),
                       [entry](Scene& scene) { scene.simulation.effects.emplace(entry->name, defaults(*entry)); }});
  for (const registry::Entry* entry : catalogue().passes)
    changes.push_back({fmt::format("passes: \"{}\": {{}}", entry->name),
                       [entry](Scene& scene) { scene.passes.emplace(entry->name, defaults(*entry)); }});
  changes.push_back(
      {R"(set "material.evaluate" to "direct")", [](Scene& scene) { scene.material.evaluate = "direct"; }});
  for (std::string_view method : scene::k_render_methods)
    changes.push_back({fmt::format("\"render\": {{\"method\": \"{}\"}}", method),
                       [method](Scene& scene) { scene.render_method = method; }});
}

void add_things(std::vector<SceneChange>& changes) {
  changes.push_back({R"("lights": [{"to_light": [0, 1, 1], "irradiance": [3, 3, 3]}])", [](Scene& scene) {
                       scene.lights.push_back({"", {0, 1, 1}, glm::dvec3(3)});
                     }});
  changes.push_back({R"("colliders": {"head": true})", [](Scene& scene) { scene.head_colliders = true; }});
  changes.push_back({R"("head": {"present": true})", [](Scene& scene) { scene.head.present = true; }});
  changes.push_back({R"("floor": {"height_m": 0})", [](Scene& scene) { scene.floor.emplace(); }});
  changes.push_back({R"("fins": {"mesh": FILE, "weights": FILE})", [](Scene& scene) { scene.fins.emplace(); }});
  changes.push_back({R"("character": {"file": FILE})", [](Scene& scene) { scene.character.emplace(); }});
  changes.push_back({R"("motion": {"bvh": FILE})", [](Scene& scene) { scene.motion.emplace(); }});
}

void add_outputs(std::vector<SceneChange>& changes) {
  changes.push_back({R"("outputs": {"color": true})", [](Scene& scene) { scene.outputs.color = true; }});
  changes.push_back({R"("outputs": {"aovs": true})", [](Scene& scene) { scene.outputs.aovs = true; }});
  changes.push_back({R"("camera": {"turntable_deg_per_frame": 1})",
                     [](Scene& scene) { scene.camera.turntable_degrees_per_frame = 1; }});
  changes.push_back({R"("groom": {"file": FILE})", [](Scene& scene) {
                       scene.groom.file = "FILE";
                       scene.groom.interpolate = false;
                     }});
  changes.push_back({R"("groom": {"interpolate": true})", [](Scene& scene) {
                       if (!scene.groom.file.empty()) scene.groom.interpolate = true;
                     }});
  changes.push_back(
      {R"("material": {"evaluate": "tables"})", [](Scene& scene) { scene.material.evaluate = "tables"; }});
}

std::vector<SceneChange> all_changes() {
  std::vector<SceneChange> changes;
  add_things(changes);
  add_registered(changes);
  add_outputs(changes);
  return changes;
}

const std::string* why_left_out(const Plan& plan, const registry::Entry& entry) {
  const auto found = std::ranges::find(plan.left_out, &entry, &LeftOut::entry);
  return found == plan.left_out.end() ? nullptr : &found->reason;
}

/// A scene that was changed so far, and how.
struct Step {
  Scene scene;
  std::vector<std::string> changes;
  Plan plan;
};

/// One change further: the ways in, and what altered the reason.
struct Further {
  std::vector<Step> in, closer;
};
Further one_further(const Step& from, const registry::FrameShape& shape, const DeviceTraits& device,
                    const registry::Entry& entry) {
  Further further;
  const std::string* const before = why_left_out(from.plan, entry);
  for (const SceneChange& change : scene_changes()) {
    Step next{from.scene, from.changes, {}};
    change.make(next.scene);
    next.changes.push_back(change.words);
    registry::FrameShape next_shape = shape;
    next_shape.lights = std::uint32_t(next.scene.lights.size());
    next.plan = make_plan(next.scene, next_shape, device);
    const std::string* const now = why_left_out(next.plan, entry);
    if (!now)
      further.in.push_back(std::move(next));
    else if (before && *now != *before)
      further.closer.push_back(std::move(next));
  }
  return further;
}

}  // namespace

const std::vector<SceneChange>& scene_changes() {
  static const std::vector<SceneChange> changes = all_changes();
  return changes;
}

std::optional<WayIn> way_in(const Scene& scene, const registry::FrameShape& shape, const DeviceTraits& device,
                            const registry::Entry& entry, int most) {
  constexpr std::size_t k_followed = 6;  // reasons that lead on are few; the rest are other ways of not having it
  std::vector<Step> from(1);
  from[0] = {scene, {}, make_plan(scene, shape, device)};
  for (int step = 0; step < most && !from.empty(); ++step) {
    std::vector<Step> in, closer;
    for (const Step& each : from) {
      Further further = one_further(each, shape, device, entry);
      std::ranges::move(further.in, std::back_inserter(in));
      std::ranges::move(further.closer, std::back_inserter(closer));
    }
    if (!in.empty()) {
      Step& best = *std::ranges::min_element(in, {}, [](const Step& way) { return way.plan.passes.size(); });
      return WayIn{std::move(best.changes), std::move(best.plan)};
    }
    if (closer.size() > k_followed) closer.resize(k_followed);
    from = std::move(closer);
  }
  return std::nullopt;
}

}  // namespace cuticle::plan
