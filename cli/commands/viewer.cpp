#include <filesystem>

#include <fmt/core.h>

#include "cli/command.h"
#include "cli/groom_options.h"
#include "cli/model_options.h"
#include "cli/run_folder.h"
#include "cli/shared_files.h"
#include "cli/usd_files.h"
#include "viz/page/page.h"

namespace cuticle::cli {

namespace {

namespace fs = std::filesystem;

struct ViewerRequest {
  std::string groom, out = "viewer", head, three;
  double head_metres_per_unit = 0;
  std::size_t strands = 20000;
  strands::ReadOptions read;
  ParameterRequest parameters;
};

/// Hair of a named fibre is a circle to the page, whatever its aspect.
Result<bsdf::marschner::Parameters> model_of(const ParameterRequest& request) {
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model("marschner"));
  ParameterRequest asked = request;
  if (asked.hair.empty() && asked.preset.empty() && asked.settings.empty()) asked.hair = "blond";
  CUTICLE_ASSIGN(const registry::ParameterValues values, parameters_of(*model, asked));
  auto parameters = registry::from_values<bsdf::marschner::Parameters>(values);
  if (request.settings.find("aspect") == std::string::npos) parameters.aspect = 1;
  return parameters;
}

Result<void> write_viewer(const ViewerRequest& request, Progress& progress) {
  viz::page::PageRequest page;
  page.three = request.three;
  page.also = share_file("tests/browser/node_modules");
  page.strands = request.strands;
  CUTICLE_ASSIGN(page.model, model_of(request.parameters));
  CUTICLE_TRY(viz::page::check_page(page));
  CUTICLE_ASSIGN(strands::GroomFile file, read_groom_file(request.groom, request.read));
  for (const std::string& note : file.notes) progress.message(note);
  if (!request.head.empty()) {
    const double unit = request.head_metres_per_unit > 0 ? request.head_metres_per_unit : file.metres_per_unit;
    CUTICLE_ASSIGN(page.head, strands::read_obj(request.head, unit));
  }
  page.groom = std::move(file.groom);
  page.title = fs::path(request.groom).filename().string();
  return viz::page::write_page(page, request.out, progress);
}

int act_viewer(const ViewerRequest& request, const Context& context) {
  const auto written = write_viewer(request, *context.progress);
  if (!written) return report(written.error());
  fmt::print("{}/index.html: open it in a browser, or send the folder on\n", request.out);
  return Exit::ok;
}

}  // namespace

void add_viewer(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand(
      "viewer", "write a folder that shows a groom in any browser: hair by tables, with sliders and shadow (three.js)");
  auto request = std::make_shared<ViewerRequest>();
  command->add_option("groom", request->groom, groom_help(false))->required();
  command->add_option("--out", request->out, "folder to write (default: viewer)");
  command->add_option("--head", request->head, "mesh that the hair grows on (OBJ)");
  command->add_option("--head-metres-per-unit", request->head_metres_per_unit, "scale of the head; 0 = as the groom's")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--strands", request->strands, "at most so many are shown, as much wider as they are fewer")
      ->check(CLI::Range(std::size_t(1), std::size_t(200000)))
      ->capture_default_str();
  command->add_option("--three", request->three,
                      "folder of the npm package three, which the page takes in (default: CUTICLE_THREE, or "
                      "node_modules here or above)");
  add_parameter_options(*command, request->parameters);
  add_groom_options(*command, request->read.metres_per_unit, request->read.radius);
  command->callback([&context, request] {
    context.action = [&context, request] {
      return in_folder(request->out, [&] { return act_viewer(*request, context); });
    };
  });
}

}  // namespace cuticle::cli
