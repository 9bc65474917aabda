#include "cli/view/view.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "strands/formats/formats.h"

namespace cuticle::cli {
namespace {

struct StrandsOptions : ViewOptions {
  std::vector<std::string> runs;
  std::string color, light = "0.5,1,0.6", mesh;
  std::vector<std::string> spheres;
  int frame = -1, strand = -1;
  double metres_per_unit = 0, alpha = 0.4, density = 0;
};

Result<viz::StrandColoring> coloring_of(const StrandsOptions& options) {
  viz::StrandColoring coloring{options.color};
  coloring.alpha = options.alpha;
  CUTICLE_ASSIGN(coloring.to_light, parse_vector("--light", options.light));
  if (!(glm::length(coloring.to_light) > 0)) return usage_error("--light: 0,0,0 is no direction", "--light 0.5,1,0.6");
  for (const std::string& text : options.spheres) {
    CUTICLE_ASSIGN(const std::vector<double> numbers, parse_numbers("--sphere", text));
    if (numbers.size() != 4 || !(numbers[3] > 0))
      return usage_error("--sphere: '" + text + "' is not x,y,z,radius", "--sphere 0,0,0,0.09");
    coloring.colliders.push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3]});
  }
  return coloring;
}

Result<viz::StrandsView> view_of(const StrandsOptions& options) {
  viz::StrandsView view;
  for (const std::string& path : options.runs) {
    CUTICLE_ASSIGN(view.runs.emplace_back(), viz::find_run(path));
  }
  if (view.runs.size() == 2 && view.runs[0].name == view.runs[1].name)
    for (std::size_t k = 0; k < 2; ++k)
      view.runs[k].name =
          options.runs[0] == options.runs[1] ? fmt::format("{} ({})", view.runs[k].name, k + 1) : options.runs[k];
  if (options.frame >= 0) {
    CUTICLE_ASSIGN(view.frame, viz::frame_at(view.runs.front(), options.frame));
  } else {
    view.frame = int(view.runs.front().frames.size()) - 1;
  }
  view.metres_per_unit = options.metres_per_unit;
  view.density_cell = options.density;
  if (options.strand >= 0) view.strand = std::size_t(options.strand);
  CUTICLE_ASSIGN(view.coloring, coloring_of(options));
  if (options.mesh.empty()) return view;
  CUTICLE_ASSIGN(view.mesh,
                 strands::read_obj(options.mesh, options.metres_per_unit == 0 ? 1 : options.metres_per_unit));
  return view;
}

Result<void> view_strands(const StrandsOptions& options, Context&) {
  CUTICLE_ASSIGN(const viz::StrandsView view, view_of(options));
  return show_or_write(
      options, [&](const std::string& folder) { return viz::write_strands(view, folder); },
      [&](const viz::Views& views, const viz::ViewTarget& target) { return views.strands(view, target); });
}

}  // namespace

void add_view_strands(CLI::App& view, Context& context) {
  auto options = std::make_shared<StrandsOptions>();
  CLI::App* command =
      view.add_subcommand("strands", "a run of `simulate`, or a groom, coloured by a number per vertex");
  command->add_option("runs", options->runs, "a folder with states.pvd, a state or a groom; two are shown side by side")
      ->required()
      ->expected(1, 2);
  command->add_option("--frame", options->frame, "number of the state, 60 for state_0060.vtp; without: the last");
  command->add_option(
      "--color", options->color,
      "stretch, tension, curvature, velocity or another array of the file; arc_length, twist, strand, level, "
      "asleep, contact, guard_fired, transmittance, error:METHOD");
  command->add_option("--strand", options->strand, "whose curves are drawn; without: that of the largest value");
  command->add_option("--light", options->light, "direction to the light of transmittance and error")
      ->capture_default_str();
  command->add_option("--alpha", options->alpha, "opacity of one fibre crossing of transmittance and error")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--sphere", options->spheres, "a collider x,y,z,radius in metres, beside those of the run");
  command->add_option("--mesh", options->mesh, "growth mesh (.obj) to draw, which the run's head carries");
  command
      ->add_option("--density", options->density,
                   "draw hair's length per volume on a grid of this cell (metres), as strand_interaction counts it")
      ->check(CLI::Range(0.0, 10.0));
  command->add_option("--metres-per-unit", options->metres_per_unit, "unit of a groom's file; 0 = guess")
      ->check(CLI::Range(0.0, 1000.0));
  add_target_options(*command, *options, true);
  set_view_action(*command, context, options, view_strands);
}

}  // namespace cuticle::cli
