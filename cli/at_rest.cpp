#include "cli/at_rest.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "cli/run_folder.h"
#include "core/file.h"
#include "core/json/json.h"
#include "plan/simulation.h"
#include "sim/rod/equilibrium.h"
#include "sim/rod/hold.h"
#include "strands/formats/formats.h"
#include "strands/formats/vtp/vtp.h"

namespace cuticle::cli {
namespace {

/// The scene's `rod`, or one of its own where another solver moves the hair.
Result<registry::ParameterValues> rod_of(const scene::Scene& scene, Progress& progress) {
  CUTICLE_ASSIGN(const sim::Effect* rod, sim::find_effect("rod"));
  if (scene.simulation.solver && scene.simulation.solver->name == "rod") return scene.simulation.solver->values;
  progress.message("the scene has no solver 'rod': the equilibrium is that of rods by default");
  return registry::default_values(rod->entry.parameters);
}

/// What a frame would have beside gravity and colliders, and an equilibrium leaves out.
void say_what_is_left_out(const sim::EffectBlocks& effects, Progress& progress) {
  for (const auto& [name, values] : effects)
    if (name != "gravity" && name != "colliders" && name != "sleep")
      progress.message(fmt::format("effect '{}' takes no part in the equilibrium", name));
}

struct Found {
  sim::rod::Equilibrium equilibrium;
  std::vector<sim::rod::Hold> holds;
  double seconds = 0;
};

std::string table_of(const Found& found) {
  std::string text = "strand,residual,steps,depth_m,balanced,stable,stiffening,held\n";
  for (std::size_t s = 0; s < found.holds.size(); ++s) {
    const sim::rod::StrandRest& rest = found.equilibrium.strands[s];
    text += fmt::format("{},{:.3g},{},{:.3g},{:d},{:d},{:.6g},{:d}\n", s, rest.residual, rest.steps, rest.depth,
                        rest.is_balanced, rest.is_stable, found.holds[s].stiffening, found.holds[s].is_stable);
  }
  return text;
}

struct Summary {
  std::size_t strands = 0, balanced = 0, stable = 0, stiffened = 0;
  double residual = 0, depth = 0, stiffening = 1, moved = 0;
};
Summary summary_of(const strands::Groom& groom, const Found& found) {
  Summary sum{.strands = groom.strand_count()};
  for (std::size_t s = 0; s < sum.strands; ++s) {
    const sim::rod::StrandRest& rest = found.equilibrium.strands[s];
    sum.balanced += rest.is_balanced;
    sum.stable += rest.is_stable;
    sum.stiffened += found.holds[s].stiffening > 1;
    sum.residual = std::max(sum.residual, rest.residual);
    sum.depth = std::max(sum.depth, rest.depth);
    sum.stiffening = std::max(sum.stiffening, double(found.holds[s].stiffening));
  }
  for (std::size_t v = 0; v < groom.vertex_count(); ++v)
    sum.moved = std::max(sum.moved, double(glm::distance(groom.positions[v], found.equilibrium.positions[v])));
  return sum;
}

void print(const Summary& sum, double seconds, const std::string& folder, bool json) {
  if (json) {
    const Json text = {{"strands", sum.strands},     {"balanced", sum.balanced},
                       {"stable", sum.stable},       {"largest_residual", sum.residual},
                       {"stiffened", sum.stiffened}, {"largest_stiffening", sum.stiffening},
                       {"deepest_m", sum.depth},     {"moved_m", sum.moved},
                       {"seconds", seconds},         {"folder", folder}};
    fmt::print("{}\n", text.dump(2));
    return;
  }
  fmt::print("{} of {} strands at rest, {} of them stable; largest residual {:.1e} of weight times length\n",
             sum.balanced, sum.strands, sum.stable, sum.residual);
  fmt::print(
      "moved by {:.3g} m at most, {:.1e} m inside a collider, {} stiffened, by {:.3g} at most, {:.2f} s, in {}\n",
      sum.moved, sum.depth, sum.stiffened, sum.stiffening, seconds, folder);
}

Result<void> write_all(const strands::Groom& groom, const Found& found, std::span<const sim::PlacedCollider> colliders,
                       const AtRestRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(RunFolder folder, RunFolder::open(request.out));
  const std::span<const glm::vec3> places = found.equilibrium.positions;
  if (request.vtp) {
    const std::vector<glm::vec3> still(places.size());
    const std::vector<float> stretch = sim::stretch(groom, places), curvature = sim::curvature(groom, places);
    const std::vector<float> contact = sim::distances(colliders, places);
    CUTICLE_TRY(write_text_file(request.out + "/rest.vtp",
                                strands::format_vtp({&groom, places, still, stretch, {}, curvature, contact, {}})));
    folder.add("rest.vtp");
  }
  if (request.hair) {
    strands::Groom moved = groom;
    moved.positions = found.equilibrium.positions;
    CUTICLE_ASSIGN([[maybe_unused]] const auto notes, strands::write_groom(request.out + "/rest.hair", moved));
    folder.add("rest.hair");
  }
  CUTICLE_TRY(write_text_file(request.out + "/rest.csv", table_of(found)));
  folder.add("rest.csv");
  return folder.finish("simulate", true, progress);
}

Result<bool> run(const AtRestRequest& request, Context& context) {
  CUTICLE_ASSIGN(const scene::Scene scene, scene::load_scene(request.scene, plan::catalogue()));
  CUTICLE_ASSIGN(const plan::StrandSet set, plan::build_strand_set(scene));
  const plan::Plan made = plan::make_plan(scene, plan::shape_of(scene, set));
  CUTICLE_ASSIGN(const registry::ParameterValues rod, rod_of(scene, *context.progress));
  const sim::EffectBlocks effects = plan::planned_effects(scene, made);
  say_what_is_left_out(effects, *context.progress);
  const std::vector<sim::PlacedCollider> colliders = sim::placed_colliders(
      {.colliders = set.colliders, .boxes = set.boxes, .fields = set.fields, .moving = set.moving});
  const auto start = std::chrono::steady_clock::now();
  Found found;
  CUTICLE_ASSIGN(found.equilibrium,
                 sim::rod::find_equilibrium(set.control, rod, effects, {.colliders = colliders}, *context.progress));
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  CUTICLE_ASSIGN(found.holds, sim::rod::find_holds(set.control, rod, effects));
  CUTICLE_TRY(write_all(set.control, found, colliders, request, *context.progress));
  const Summary sum = summary_of(set.control, found);
  print(sum, found.seconds, request.out, context.json);
  return sum.balanced == sum.strands;
}

}  // namespace

int simulate_at_rest(const AtRestRequest& request, Context& context) {
  const Result<bool> all = run(request, context);
  if (!all) return report(all.error());
  return *all ? Exit::ok : Exit::check_failed;
}

}  // namespace cuticle::cli
