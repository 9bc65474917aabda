#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/core.h>

#include "cli/command.h"
#include "cli/groom_options.h"
#include "cli/model_options.h"
#include "cli/run_folder.h"
#include "cli/shared_files.h"
#include "cli/usd_files.h"
#include "cli/viewer/page.h"
#include "core/file.h"
#include "lut/format.h"
#include "lut/snippets/snippet.h"
#include "lut/table_set.h"
#include "lut/target.h"

namespace cuticle::cli {

namespace {

namespace fs = std::filesystem;

/// Strands that cover a head as they are, and how much fewer ones are drawn wider at first.
constexpr std::size_t k_full_head = 40000;
constexpr double k_max_widening = 12;

struct ViewerRequest {
  std::string groom, out = "viewer", head, three;
  double head_metres_per_unit = 0;
  std::size_t strands = 20000;
  strands::ReadOptions read;
  ParameterRequest parameters;
};

/// The package three of npm: as given, in CUTICLE_THREE, in node_modules here or above, or where the browser tests have
/// it.
Result<std::string> three_folder(const std::string& given) {
  std::vector<fs::path> places;
  if (!given.empty()) places.emplace_back(given);
  if (const char* named = std::getenv("CUTICLE_THREE"); given.empty() && named) places.emplace_back(named);
  if (given.empty()) {
    std::error_code failed;
    for (fs::path folder = fs::current_path(failed); !folder.empty(); folder = folder.parent_path()) {
      places.push_back(folder / "node_modules/three");
      if (folder == folder.parent_path()) break;
    }
    places.emplace_back(share_file("tests/browser/node_modules/three"));
  }
  for (const fs::path& place : places)
    if (fs::exists(place / "build/three.module.js")) return place.string();
  return bad_input(given.empty() ? "three.js was not found: the page is made with it"
                                 : fmt::format("{}: holds no build/three.module.js", given),
                   "npm install three@0.187.0 here, or name its folder with --three");
}

/// Every so many strands, as much wider as they are fewer.
strands::Groom thinned(const strands::Groom& groom, std::size_t most) {
  if (groom.strand_count() <= most) return groom;
  strands::Groom kept;
  const double step = double(groom.strand_count()) / double(most);
  for (std::size_t k = 0; k < most; ++k) {
    const auto s = std::size_t(double(k) * step);
    const std::uint32_t first = groom.offsets[s], last = groom.offsets[s + 1];
    kept.positions.insert(kept.positions.end(), groom.positions.begin() + first, groom.positions.begin() + last);
    for (std::uint32_t v = first; v < last; ++v) kept.radii.push_back(groom.radii[v] * float(step));
    kept.offsets.push_back(std::uint32_t(kept.positions.size()));
  }
  return kept;
}

/// What the page can bake: the corrected model of a round fibre with its exact caustic.
Result<bsdf::marschner::Parameters> model_of(const ParameterRequest& request, const registry::ParameterValues& values) {
  const auto parameters = registry::from_values<bsdf::marschner::Parameters>(values);
  using namespace bsdf::marschner;
  if (parameters.variant == Variant::corrected && parameters.caustic == CausticKind::exact &&
      parameters.attenuation_angle == AttenuationAngle::theta_d &&
      (parameters.aspect == 1 || request.settings.find("aspect") == std::string::npos))
    return parameters;
  return usage_error("the viewer shows variant=corrected, caustic=exact, attenuation_angle=theta_d, aspect=1",
                     "leave them out of --set");
}

/// The functions that read the tables, as `cuticle bake --target three` writes them.
Result<std::string> snippet_of(const bsdf::Model& model, const registry::ParameterValues& values, Progress& progress) {
  CUTICLE_ASSIGN(const lut::Layout* layout, lut::find_layout("nalu_theta", model, values));
  CUTICLE_ASSIGN(const lut::Format* format, lut::find_format("exr"));
  CUTICLE_ASSIGN(lut::TableSet set, lut::bake(model, values, *layout, 128, progress));
  CUTICLE_TRY(lut::certify(set, *format, progress));
  CUTICLE_ASSIGN(const lut::Manifest manifest, lut::parse_manifest(lut::manifest_json(set, *format), "manifest"));
  CUTICLE_ASSIGN(const lut::snippets::Dialect* glsl, lut::snippets::find_dialect("glsl"));
  return lut::engine_snippet(manifest, "glsl", lut::snippets::declarations(manifest, *glsl));
}

Result<void> write_viewer(const ViewerRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const std::string three, three_folder(request.three));
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model("marschner"));
  ParameterRequest asked = request.parameters;
  if (asked.hair.empty() && asked.preset.empty() && asked.settings.empty()) asked.hair = "blond";
  CUTICLE_ASSIGN(const registry::ParameterValues values, parameters_of(*model, asked));
  CUTICLE_ASSIGN(const bsdf::marschner::Parameters parameters, model_of(request.parameters, values));
  CUTICLE_ASSIGN(const strands::GroomFile file, read_groom_file(request.groom, request.read));
  for (const std::string& note : file.notes) progress.message(note);
  const strands::Groom& groom = file.groom;
  strands::Mesh head;
  if (!request.head.empty()) {
    const double unit = request.head_metres_per_unit > 0 ? request.head_metres_per_unit : file.metres_per_unit;
    CUTICLE_ASSIGN(head, strands::read_obj(request.head, unit));
  }
  CUTICLE_ASSIGN(const std::string snippet, snippet_of(*model, values, progress));
  // A groom of guides alone would be too thin to look at.
  const double widen = std::clamp(std::round(double(k_full_head) / double(groom.strand_count())), 1.0, k_max_widening);
  const strands::Groom shown = thinned(groom, request.strands);
  const std::string title = fs::path(request.groom).filename().string();
  const std::string words =
      shown.strand_count() == groom.strand_count()
          ? fmt::format("{} strands", groom.strand_count())
          : fmt::format("{} of {} strands, as much wider", shown.strand_count(), groom.strand_count());
  CUTICLE_ASSIGN(const std::string page, viewer::page(three, snippet, title));
  CUTICLE_TRY(make_folder(request.out));
  CUTICLE_TRY(
      write_text_file(request.out + "/hair.js", viewer::hair_script(shown, head, parameters, title, words, widen)));
  return write_text_file(request.out + "/index.html", page);
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
