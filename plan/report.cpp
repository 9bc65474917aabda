// A plan as text and as JSON.
#include <fmt/core.h>

#include "core/json/json.h"
#include "plan/plan.h"

namespace cuticle::plan {

namespace {

Json shape_json(const registry::FrameShape& shape) {
  return {{"control_strands", shape.control_strands},
          {"control_vertices", shape.control_vertices},
          {"strands", shape.strands},
          {"vertices", shape.vertices},
          {"segments", shape.segments},
          {"substeps", shape.substeps},
          {"lights", shape.lights}};
}

Json passes_json(const Plan& plan) {
  Json list = Json::list();
  for (const PlannedPass& pass : plan.passes)
    list.push_back(
        {{"name", pass.entry->name}, {"reason", pass.reason}, {"dispatches", pass.dispatches}, {"draws", pass.draws}});
  return list;
}

Json left_out_json(const Plan& plan) {
  Json list = Json::list();
  for (const LeftOut& left : plan.left_out) list.push_back({{"name", left.entry->name}, {"reason", left.reason}});
  return list;
}

Json names_json(const std::vector<const registry::Entry*>& entries) {
  Json list = Json::list();
  for (const registry::Entry* entry : entries) list.push_back(entry->name);
  return list;
}

Json resources_json(const Plan& plan) {
  Json list = Json::list();
  for (const PlannedResource& resource : plan.resources)
    list.push_back({{"name", resource.name},
                    {"made_by", names_json(resource.writers)},
                    {"read_by", names_json(resource.readers)}});
  return list;
}

}  // namespace

std::string to_text(const Plan& plan) {
  const registry::FrameShape& shape = plan.shape;
  std::string text = fmt::format(
      "{} control hairs ({} vertices), {} drawn strands ({} vertices), {} light(s), {} substep(s) a frame\n\n",
      shape.control_strands, shape.control_vertices, shape.strands, shape.vertices, shape.lights, shape.substeps);
  text += fmt::format("{:<20} {:>10} {:>6}  {}\n", "pass", "dispatches", "draws", "because");
  for (const PlannedPass& pass : plan.passes)
    text += fmt::format("{:<20} {:>10} {:>6}  {}\n", pass.entry->name, pass.dispatches, pass.draws, pass.reason);
  if (!plan.left_out.empty()) text += fmt::format("\n{:<20} {}\n", "left out", "because");
  for (const LeftOut& left : plan.left_out) text += fmt::format("{:<20} {}\n", left.entry->name, left.reason);
  return text;
}

std::string to_json(const Plan& plan) {
  Json facts = Json::object();
  for (const auto& [name, fact] : plan.facts) facts[name] = {{"holds", fact.holds}, {"why", fact.why}};
  const Json json = {{"shape", shape_json(plan.shape)},
                     {"facts", facts},
                     {"passes", passes_json(plan)},
                     {"resources", resources_json(plan)},
                     {"left_out", left_out_json(plan)}};
  return json.dump(2);
}

}  // namespace cuticle::plan
