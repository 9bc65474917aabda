#include "plan/frame_graph.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "render/frame.h"
#include "render/inputs.h"
#include "render/pass.h"
#include "render/passes/strands_in_sight/strands_in_sight.h"
#include "shadows/method.h"

namespace cuticle::plan {

namespace {

using render::Access, render::Use;

constexpr Use k_shadow_uses[] = {
    render::reads<render::Lights>(), render::reads<render::FibreOpacity>(), render::reads<render::DrawnHair>(),
    render::may_read<render::strands_in_sight::StrandsInSight>(), render::writes<render::HairTransmittance>()};

bool is_output(const Use& use) { return use.access == Access::writes || use.access == Access::changes; }

/// Resources that some pass makes, whether it is planned or not: the others the scene gives.
std::set<std::string_view> made_by_passes() {
  std::set<std::string_view> made;
  for (const render::Pass* pass : render::passes())
    for (const Use& use : pass->uses)
      if (use.access == Access::writes) made.insert(use.resource);
  return made;
}

class Graph {
 public:
  explicit Graph(Plan& plan) : plan_(plan) {}

  void compile() {
    do find_needed();
    while (drop_without_source());
    leave_out_unread();
    sort();
    list_resources();
  }

 private:
  bool counts(const Use& use) const {
    const auto fact = plan_.facts.find(use.where_fact);
    return (use.for_resource.empty() || needed_.contains(use.for_resource)) &&
           (use.where_fact.empty() || (fact != plan_.facts.end() && fact->second.holds));
  }

  bool is_needed(const registry::Entry& entry) const {
    const auto uses = uses_of(entry);
    return uses.empty() ||
           std::ranges::any_of(uses, [&](const Use& use) { return is_output(use) && needed_.contains(use.resource); });
  }

  /// Backwards from the outputs: what a needed pass reads is needed too.
  void find_needed() {
    needed_ = {plan_.outputs.begin(), plan_.outputs.end()};
    for (std::size_t before = 0; before != needed_.size();) {
      before = needed_.size();
      for (const PlannedPass& pass : plan_.passes)
        if (is_needed(*pass.entry))
          for (const Use& use : uses_of(*pass.entry))
            if ((use.access == Access::reads || use.access == Access::may_read) && counts(use))
              needed_.insert(use.resource);
    }
  }

  bool is_written(std::string_view resource) const {
    return std::ranges::any_of(plan_.passes, [&](const PlannedPass& pass) {
      return std::ranges::any_of(uses_of(*pass.entry), [&](const Use& use) {
        return use.resource == resource && use.access == Access::writes;
      });
    });
  }

  bool drop_without_source() {
    static const std::set<std::string_view> made = made_by_passes();
    for (auto pass = plan_.passes.begin(); pass != plan_.passes.end(); ++pass)
      for (const Use& use : uses_of(*pass->entry)) {
        if (use.access != Access::reads || !made.contains(use.resource) || is_written(use.resource)) continue;
        plan_.left_out.push_back({pass->entry, fmt::format("no pass of this scene makes '{}'", use.resource)});
        plan_.passes.erase(pass);
        return true;
      }
    return false;
  }

  void leave_out_unread() {
    std::erase_if(plan_.passes, [&](const PlannedPass& pass) {
      if (is_needed(*pass.entry)) return false;
      plan_.left_out.push_back({pass.entry, why_unread(*pass.entry)});
      return true;
    });
    for (PlannedPass& pass : plan_.passes) pass.reason = why_needed(pass);
  }

  std::string why_unread(const registry::Entry& entry) const {
    const registry::Fact& picture = plan_.facts.at("output_color");
    if (!picture.holds) return picture.why;
    std::vector<std::string_view> made;
    for (const Use& use : uses_of(entry))
      if (is_output(use)) made.push_back(use.resource);
    return fmt::format("no pass of this scene reads '{}'", fmt::join(made, "', '"));
  }

  /// The facts that demand a pass, else who reads what it makes.
  std::string why_needed(const PlannedPass& pass) const {
    if (!pass.entry->demands.empty() || uses_of(*pass.entry).empty()) return pass.reason;
    std::set<std::string> readers;
    for (const Use& made : uses_of(*pass.entry)) {
      if (!is_output(made)) continue;
      if (std::ranges::find(plan_.outputs, made.resource) != plan_.outputs.end())
        readers.insert(fmt::format("'{}' is wanted", made.resource));
      for (const PlannedPass& other : plan_.passes)
        if (reads(*other.entry, made.resource))
          readers.insert(fmt::format("'{}' reads '{}'", other.entry->name, made.resource));
    }
    return fmt::format("{}", fmt::join(readers, "; "));
  }

  bool reads(const registry::Entry& entry, std::string_view resource) const {
    return std::ranges::any_of(uses_of(entry), [&](const Use& use) {
      return use.resource == resource && !is_output(use) && (use.access == Access::takes || counts(use));
    });
  }

  static int rank(const registry::Entry& entry, std::string_view resource) {
    int rank = -1;
    for (const Use& use : uses_of(entry))
      if (use.resource == resource)
        rank = std::max(rank, use.access == Access::writes ? 0 : use.access == Access::changes ? 1 : 2);
    return rank;
  }

  /// Who makes a resource comes before who changes it, and both before who reads it.
  static bool comes_before(const registry::Entry& a, const registry::Entry& b) {
    if (a.stage == b.stage && std::ranges::find(b.after, a.name) != b.after.end()) return true;
    for (const Use& use : uses_of(a)) {
      const int own = rank(a, use.resource), other = rank(b, use.resource);
      if (is_output(use) && own < other) return true;
    }
    return false;
  }

  static bool by_stage_and_name(const PlannedPass& a, const PlannedPass& b) {
    if (a.entry->stage != b.entry->stage) return a.entry->stage < b.entry->stage;
    return a.entry->name < b.entry->name;
  }

  /// By stage, then by name, but no pass before one that makes what it reads.
  void sort() {
    std::vector<PlannedPass>& passes = plan_.passes;
    std::ranges::sort(passes, by_stage_and_name);
    for (auto place = passes.begin(); place != passes.end(); ++place) {
      const auto next = std::find_if(place, passes.end(), [&](const PlannedPass& pass) {
        return std::none_of(place, passes.end(), [&](const PlannedPass& other) {
          return &other != &pass && comes_before(*other.entry, *pass.entry);
        });
      });
      if (next != passes.end()) std::rotate(place, next, next + 1);
    }
  }

  void list_resources() {
    std::map<std::string_view, PlannedResource> all;
    for (const std::string_view output : plan_.outputs) all[output].name = output;
    for (const PlannedPass& pass : plan_.passes)
      for (const Use& use : uses_of(*pass.entry)) {
        if (!needed_.contains(use.resource)) continue;
        PlannedResource& resource = all[use.resource];
        resource.name = use.resource;
        if (is_output(use))
          resource.writers.push_back(pass.entry);
        else if (reads(*pass.entry, use.resource))
          resource.readers.push_back(pass.entry);
      }
    for (auto& [name, resource] : all) plan_.resources.push_back(std::move(resource));
  }

  Plan& plan_;
  std::set<std::string_view> needed_;
};

}  // namespace

std::span<const Use> uses_of(const registry::Entry& entry) {
  if (entry.kind == registry::EntryKind::method) return entry.name == "none" ? std::span<const Use>() : k_shadow_uses;
  const render::Pass* const pass = render::pass_of(entry);
  return pass ? pass->uses : std::span<const Use>();
}

void compile(Plan& plan) { Graph(plan).compile(); }

}  // namespace cuticle::plan
