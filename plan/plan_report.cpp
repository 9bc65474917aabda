#include "plan/plan_report.h"

#include <algorithm>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "core/json/json.h"
#include "plan/fact_origin.h"
#include "plan/opacity_runs.h"

namespace cuticle::plan {

namespace {

template <class Map>
auto find_in(const Map& map, std::string_view name) {
  const auto found = map.find(name);
  return found == map.end() ? std::optional<typename Map::mapped_type>() : std::optional(found->second);
}

/// One planned pass as a report shows it.
struct Line {
  const PlannedPass* pass;
  bool runs = true;
  std::string reason;
  std::optional<double> predicted, measured;
  std::optional<std::size_t> bytes;
};

std::vector<Line> lines_of(const scene::Scene& scene, const Plan& plan, const PlanCosts& costs) {
  std::vector<Line> lines;
  for (std::size_t k = 0; k < plan.passes.size(); ++k) {
    const PlannedPass& pass = plan.passes[k];
    Line line{&pass,
              true,
              pass.reason,
              {},
              find_in(costs.measured_ms, pass.entry->name),
              find_in(costs.bytes, pass.entry->name)};
    if (costs.frame) {
      line.runs = costs.frame->passes[k].runs;
      line.reason = costs.frame->passes[k].reason;
      if (!line.runs) line.measured = 0;
    }
    if (costs.table) line.predicted = predicted_ms(*costs.table, *pass.entry, plan.shape, pixels_of(scene));
    if (line.predicted && pass.entry->kind == registry::EntryKind::method) *line.predicted *= opacity_runs(scene).runs;
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string in_ms(const std::optional<double>& ms) { return ms ? fmt::format("{:.2f}", *ms) : "-"; }
std::string in_mib(const std::optional<std::size_t>& bytes) {
  return bytes ? fmt::format("{:.2f}", double(*bytes) / (1 << 20)) : "-";
}

std::string where_it_runs(const Line& line) {
  if (!line.runs) return "left out";
  if (line.pass->on_cpu) return "CPU";
  return line.pass->dispatches + line.pass->draws > 0 ? "device" : "within";
}

std::string head_text(const Plan& plan, const PlanCosts& costs) {
  const registry::FrameShape& shape = plan.shape;
  std::string text = fmt::format(
      "{} control hairs ({} vertices), {} drawn strands ({} vertices), {} light(s), {} substep(s) a frame\n",
      shape.control_strands, shape.control_vertices, shape.strands, shape.vertices, shape.lights, shape.substeps);
  if (!costs.device.name.empty()) text += fmt::format("device: {}\n", costs.device.name);
  text += costs.table
              ? fmt::format("expected times: from this device's calibration ({})\n", costs.table->made)
              : "expected times: not measured on this device; cuticle plan --calibrate takes at most a minute\n";
  return text;
}

std::string passes_text(std::span<const Line> lines, const PlanCosts& costs) {
  std::string text = fmt::format("\n{:<22} {:<8} {:>10} {:>5} {:>8} {:>11} {:>11}  {}\n",
                                 costs.frame ? fmt::format("frame {}", costs.frame->frame) : "pass", "on", "dispatches",
                                 "draws", "MiB", "expected ms", "measured ms", "because");
  for (const Line& line : lines)
    text += fmt::format("{:<22} {:<8} {:>10} {:>5} {:>8} {:>11} {:>11}  {}\n", line.pass->entry->name,
                        where_it_runs(line), line.runs ? line.pass->dispatches : 0, line.runs ? line.pass->draws : 0,
                        in_mib(line.bytes), in_ms(line.predicted), in_ms(line.measured), line.reason);
  return text;
}

std::string left_out_text(std::span<const LeftOutEntry> entries) {
  std::string text;
  for (const GroupSaving& group : savings(entries)) {
    if (group.entries == 0) continue;
    text += "\n" + words_of_saving(group) + "\n";
    for (const LeftOutEntry& entry : entries)
      if (group_of(*entry.left->entry) == group.group)
        text += fmt::format("  {:<22} {:>13}  {}; to bring it in: {}\n", entry.left->entry->name, words_of_cost(entry),
                            entry.left->reason, words_of_way(entry));
  }
  return text;
}

registry::Facts all_facts(const Plan& plan, const PlanCosts& costs) {
  registry::Facts facts = plan.facts;
  if (costs.frame) facts.insert(costs.frame->facts.begin(), costs.frame->facts.end());
  return facts;
}

Json optional_json(const auto& value) { return value ? Json(*value) : Json(nullptr); }

Json facts_json(const registry::Facts& facts) {
  Json json = Json::object();
  for (const auto& [name, fact] : facts)
    json[name] = {{"holds", fact.holds}, {"why", fact.why}, {"origin", origin_of(name)}};
  return json;
}

Json names_json(std::span<const std::string_view> names) {
  Json list = Json::list();
  for (std::string_view name : names) list.push_back(std::string(name));
  return list;
}

Json line_json(const Line& line) {
  return {{"name", std::string(line.pass->entry->name)},
          {"group", std::string(group_of(*line.pass->entry))},
          {"reason", line.reason},
          {"demands", names_json(line.pass->entry->demands)},
          {"runs", line.runs},
          {"on_cpu", line.pass->on_cpu},
          {"dispatches", line.runs ? line.pass->dispatches : 0},
          {"draws", line.runs ? line.pass->draws : 0},
          {"bytes", optional_json(line.bytes)},
          {"expected_ms", optional_json(line.predicted)},
          {"measured_ms", optional_json(line.measured)}};
}

Json left_out_json(const LeftOutEntry& entry) {
  return {{"name", std::string(entry.left->entry->name)},
          {"group", std::string(group_of(*entry.left->entry))},
          {"reason", entry.left->reason},
          {"changes", entry.way ? Json(entry.way->changes) : Json(nullptr)},
          {"more_ms", optional_json(entry.more_ms)},
          {"alternative", entry.is_alternative}};
}

Json saving_json(const GroupSaving& group) {
  return {{"group", std::string(group.group)},
          {"left_out", group.entries},
          {"not_measured", group.not_measured},
          {"alternatives", group.alternatives},
          {"saved_ms", group.not_measured < group.entries - group.alternatives ? Json(group.ms) : Json(nullptr)}};
}

std::string demands_text(const registry::Entry& entry, const registry::Facts& facts) {
  std::string text;
  for (std::string_view demand : entry.demands) {
    const auto fact = facts.find(demand);
    text += fmt::format("  {:<22} {:<5} {}  [{}]\n", demand,
                        fact == facts.end()  ? "?"
                        : fact->second.holds ? "yes"
                                             : "no",
                        fact == facts.end() ? "nothing says it" : fact->second.why, origin_of(demand));
  }
  return text.empty() ? "  nothing: it always runs\n" : text;
}

const registry::Entry* find_entry(const Plan& plan, std::string_view name) {
  for (const PlannedPass& pass : plan.passes)
    if (pass.entry->name == name) return pass.entry;
  for (const LeftOut& left : plan.left_out)
    if (left.entry->name == name) return left.entry;
  return nullptr;
}

Error no_such_pass(const Plan& plan, std::string_view name) {
  std::vector<std::string_view> known;
  for (const PlannedPass& pass : plan.passes) known.push_back(pass.entry->name);
  for (const LeftOut& left : plan.left_out) known.push_back(left.entry->name);
  const std::string near = registry::nearest_name(std::string(name), known);
  return usage_error(fmt::format("--why: '{}' is no pass, effect, solver or shadow method", name),
                     near.empty() ? "cuticle passes, effects and methods list them" : fmt::format("write '{}'", near));
}

}  // namespace

std::string report_text(const scene::Scene& scene, const Plan& plan, const PlanCosts& costs) {
  std::string text = head_text(plan, costs) + passes_text(lines_of(scene, plan, costs), costs);
  text += "\nfacts\n";
  for (const auto& [name, fact] : all_facts(plan, costs))
    if (fact.holds) text += fmt::format("  {:<22} {}  [{}]\n", name, fact.why, origin_of(name));
  return text + left_out_text(explain_left_out(scene, plan, costs));
}

std::string report_json(const scene::Scene& scene, const Plan& plan, const PlanCosts& costs) {
  Json json = Json::parse(to_json(plan)).value();
  json["facts"] = facts_json(all_facts(plan, costs));
  json["device"] = costs.device.name;
  json["frame"] = costs.frame ? Json(costs.frame->frame) : Json(nullptr);
  json["passes"] = Json::list();
  for (const Line& line : lines_of(scene, plan, costs)) json["passes"].push_back(line_json(line));
  const std::vector<LeftOutEntry> entries = explain_left_out(scene, plan, costs);
  json["left_out"] = Json::list();
  for (const LeftOutEntry& entry : entries) json["left_out"].push_back(left_out_json(entry));
  json["saved"] = Json::list();
  for (const GroupSaving& group : savings(entries)) json["saved"].push_back(saving_json(group));
  return json.dump(2);
}

Result<std::string> report_why(const scene::Scene& scene, const Plan& plan, const PlanCosts& costs,
                               std::string_view pass) {
  const registry::Entry* entry = find_entry(plan, pass);
  if (!entry) return no_such_pass(plan, pass);
  std::string text = fmt::format("{}: {}\n", entry->name, entry->summary);
  for (const Line& line : lines_of(scene, plan, costs))
    if (line.pass->entry == entry)
      text += fmt::format("{}: {}\n", line.runs ? "runs" : "in the plan, not in this frame", line.reason);
  for (const LeftOutEntry& left : explain_left_out(scene, plan, costs))
    if (left.left->entry == entry)
      text += fmt::format("left out: {}\nto bring it in: {}\nwould take: {}\n", left.left->reason, words_of_way(left),
                          words_of_cost(left));
  return text + "demands\n" + demands_text(*entry, all_facts(plan, costs));
}

std::string report_dot(const Plan& plan) {
  std::string text = "digraph plan {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
  for (const auto& [name, fact] : plan.facts)
    if (fact.holds) text += fmt::format("  \"fact {}\" [label=\"{}\", shape=box, style=rounded];\n", name, name);
  for (const PlannedPass& pass : plan.passes) {
    text += fmt::format("  \"{}\" [shape=box];\n", pass.entry->name);
    for (std::string_view demand : pass.entry->demands)
      text += fmt::format("  \"fact {}\" -> \"{}\" [style=dashed];\n", demand, pass.entry->name);
  }
  for (const PlannedResource& resource : plan.resources)
    for (const registry::Entry* writer : resource.writers)
      for (const registry::Entry* reader : resource.readers)
        if (writer != reader)
          text += fmt::format("  \"{}\" -> \"{}\" [label=\"{}\"];\n", writer->name, reader->name, resource.name);
  return text + "}\n";
}

}  // namespace cuticle::plan
