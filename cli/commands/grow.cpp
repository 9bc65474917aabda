#include <numeric>

#include <fmt/core.h>

#include <cuticle/cli/command.h>
#include <cuticle/core/file.h>
#include <cuticle/strands/formats/formats.h>
#include <cuticle/strands/growing/growing.h>
#include <cuticle/strands/spline/smooth.h>

namespace cuticle::cli {

namespace {

struct Request {
  std::string specification, settings, output;
  int scalp_vertices = 300, strands = 4095, vertices = 30;
  std::uint64_t seed = 1;
};

Result<registry::ParameterValues> values_of(const Request& request) {
  const auto table = strands::growing_parameters();
  if (request.specification.empty()) return registry::parse_assignments(table, request.settings);
  CUTICLE_ASSIGN(const std::string text, read_text_file(request.specification));
  return registry::values_from_json(table, text, request.specification);
}

/// The drawn strands: control hairs planted, smoothed and interpolated.
Result<strands::Groom> grow(const Request& request) {
  CUTICLE_ASSIGN(const registry::ParameterValues values, values_of(request));
  const strands::Head head = strands::make_head(request.scalp_vertices);
  CUTICLE_ASSIGN(const strands::Groom control, strands::plant_control_hairs(head, values));
  if (request.strands == 0) return control;
  std::vector<std::uint32_t> hairs(head.scalp.positions.size());
  std::iota(hairs.begin(), hairs.end(), 0u);
  const auto roots = strands::scatter_roots(head.scalp, std::size_t(request.strands), request.seed);
  return strands::interpolate(strands::smooth(control, request.vertices), head.scalp, roots, hairs);
}

/// The growing parameters, one line each.
std::string parameters_help() {
  std::string text = "growing parameters (name, default, range, unit):\n";
  for (const registry::Parameter& parameter : strands::growing_parameters())
    text += fmt::format("  {:<18}{:<8}{} .. {}{}  {}\n", parameter.name, parameter.default_text, parameter.minimum,
                        parameter.maximum, parameter.unit == "1" ? "" : fmt::format(" {}", parameter.unit),
                        parameter.summary);
  return text;
}

int run(const Request& request, Progress& progress) {
  const auto groom = grow(request);
  if (!groom) return report(groom.error());
  const auto lost = strands::write_groom(request.output, *groom);
  if (!lost) return report(lost.error());
  for (const std::string& note : *lost) progress.message(request.output + ": " + note);
  progress.message(
      fmt::format("{}: {} strands, {} vertices written", request.output, groom->strand_count(), groom->vertex_count()));
  return Exit::ok;
}

}  // namespace

void add_grow(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand("grow", "hair on the procedural head, written as a groom in metres");
  command->footer(parameters_help());
  auto request = std::make_shared<Request>();
  auto* specification =
      command->add_option("specification", request->specification, "JSON object of growing parameters");
  command->add_option("--set", request->settings, "growing parameters as name=value,name=value")
      ->excludes(specification);
  command->add_option("--out", request->output, "groom to write: .hair or .tfx")->required();
  command->add_option("--scalp-vertices", request->scalp_vertices, "control hairs, about")
      ->check(CLI::Range(8, 100000));
  command->add_option("--strands", request->strands, "strands to write; 0 = the control hairs themselves")
      ->check(CLI::Range(0, 10000000));
  command->add_option("--vertices", request->vertices, "vertices per strand")->check(CLI::Range(2, 64));
  command->add_option("--root-seed", request->seed, "seed of the places of the roots");
  command->callback(
      [&context, request] { context.action = [&context, request] { return run(*request, *context.progress); }; });
}

}  // namespace cuticle::cli
