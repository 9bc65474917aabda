#include <glm/geometric.hpp>

#include "cli/groom_options.h"
#include "cli/shared_files.h"
#include "cli/view/view.h"
#include "shadows/method.h"
#include "strands/growing/grow.h"

namespace cuticle::cli {
namespace {

struct ShadowOptions : ViewOptions {
  std::string groom, light = "0.5,1,0.6", methods, through;
  viz::ShadowView shown;
  double metres_per_unit = 0, radius = 0;
};

/// The groom of the file; without one, a wavy head of our own.
Result<strands::Groom> groom_of(const ShadowOptions& options, Progress& progress) {
  if (!options.groom.empty())
    return load_groom(options.groom, {.metres_per_unit = options.metres_per_unit, .radius = options.radius}, progress);
  CUTICLE_ASSIGN(strands::GroomingSpecification wavy,
                 strands::load_specification(share_file("scenes/presets/wavy.json")));
  wavy.strands.share = 0.2;
  CUTICLE_ASSIGN(strands::Grown grown, strands::grow(wavy));
  return std::move(grown.drawn);
}

Result<void> view_shadow(const ShadowOptions& options, Context& context) {
  viz::ShadowView view = options.shown;
  view.name = options.groom.empty() ? "wavy hair" : options.groom.substr(options.groom.find_last_of('/') + 1);
  CUTICLE_ASSIGN(view.groom, groom_of(options, *context.progress));
  CUTICLE_ASSIGN(view.to_light, parse_vector("--light", options.light));
  if (!(glm::length(view.to_light) > 0)) return usage_error("--light: 0,0,0 is no direction", "--light 0.5,1,0.6");
  if (options.methods == "all") {
    view.methods.clear();
    for (const shadows::Method* method : shadows::methods())
      if (const auto name = method->entry.name; name != "truth" && name != "none" && name != "shadow_map")
        view.methods.emplace_back(name);  // of those three one is drawn anyway, and two tell no depth
  } else if (!options.methods.empty()) {
    view.methods = split_list(options.methods);
  }
  if (!options.through.empty()) {
    CUTICLE_ASSIGN(view.through, parse_vector("--through", options.through));
  }
  return show_or_write(
      options, [&](const std::string& folder) { return viz::write_shadow(view, folder); },
      [&](const viz::Views& views, const viz::ViewTarget& target) { return views.shadow(view, target); });
}

}  // namespace

void add_view_shadow(CLI::App& view, Context& context) {
  auto options = std::make_shared<ShadowOptions>();
  CLI::App* command = view.add_subcommand(
      "shadow", "layers of opacity maps and deep opacity maps, transmittance as a volume, optical depth along a ray");
  command->add_option("groom", options->groom, "a groom; without: wavy hair of our own");
  add_groom_options(*command, options->metres_per_unit, options->radius);
  command->add_option("--light", options->light, "direction to the light, x,y,z")->capture_default_str();
  command->add_option("--methods", options->methods,
                      "methods drawn beside truth along the ray (cuticle methods), or all");
  command->add_option("--layers", options->shown.layers, "slices and layers")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  command->add_option("--resolution", options->shown.resolution, "of the maps")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  command->add_option("--alpha", options->shown.alpha, "opacity of one fibre crossing")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--through", options->through,
                      "a place that the ray passes, x,y,z in metres; without: the middle");
  add_target_options(*command, *options);
  set_view_action(*command, context, options, view_shadow);
}

}  // namespace cuticle::cli
