#include <filesystem>

#include <fmt/core.h>

#include "cli/command.h"
#include "cli/groom_options.h"
#include "cli/parameter_help.h"
#include "cli/preset_sheet.h"
#include "cli/usd_files.h"
#include "core/file.h"
#include "strands/growing/grow.h"

namespace cuticle::cli {

namespace {

struct GrowRequest {
  std::vector<std::string> specifications;
  std::string settings, strand_settings, output, sheet;
  double share = -1;
  bool control = false, schema = false;
  int compared_roots = 0;
};

Result<strands::GroomingSpecification> specification_of(const GrowRequest& request, const std::string& file) {
  auto specification = strands::GroomingSpecification();
  if (!file.empty()) {
    CUTICLE_ASSIGN(specification, strands::load_specification(file));
  } else {
    CUTICLE_ASSIGN(specification.growing, registry::parse<strands::Style>(request.settings));
    CUTICLE_ASSIGN(specification.strands, registry::parse<strands::StrandParameters>(request.strand_settings));
  }
  if (request.share >= 0) specification.strands.share = request.share;
  return specification;
}

void tell(const std::string& what, const strands::GrowthReport& report, Progress& progress) {
  progress.message(fmt::format(
      "{}: curve at most {:.2g} mm, on average {:.2g} mm from the control polyline; {} vertices moved out of the head",
      what, 1e3 * report.deviation.largest, 1e3 * report.deviation.mean, report.moved_out));
  const strands::RootReport& roots = report.roots;
  if (roots.degenerate_triangles + roots.bare_triangles + roots.bad_densities > 0)
    progress.message(fmt::format("{}: {} degenerate and {} bare triangles, {} densities taken as 0", what,
                                 roots.degenerate_triangles, roots.bare_triangles, roots.bad_densities));
}

Result<void> write_grown(const GrowRequest& request, const std::string& file, const std::string& output,
                         Progress& progress) {
  CUTICLE_ASSIGN(const auto specification, specification_of(request, file));
  CUTICLE_ASSIGN(const strands::Grown grown, strands::grow(specification));
  tell(output, grown.report, progress);
  const strands::Groom& groom = request.control ? grown.control : grown.drawn;
  CUTICLE_ASSIGN(const std::vector<std::string> lost, write_groom_file(output, groom));
  for (const std::string& note : lost) progress.message(output + ": " + note);
  progress.message(
      fmt::format("{}: {} strands, {} vertices written", output, groom.strand_count(), groom.vertex_count()));
  return {};
}

/// One specification goes to the file named, several to a folder, each under its own name.
Result<void> write_all(const GrowRequest& request, Progress& progress) {
  if (request.specifications.size() < 2)
    return write_grown(request, request.specifications.empty() ? "" : request.specifications[0], request.output,
                       progress);
  CUTICLE_TRY(make_folder(request.output));
  std::size_t done = 0;
  for (const std::string& file : request.specifications) {
    const std::string name = std::filesystem::path(file).stem().string();
    CUTICLE_TRY(write_grown(request, file, fmt::format("{}/{}.hair", request.output, name), progress));
    progress.update("grooms", ++done, request.specifications.size());
  }
  return {};
}

/// How even each rule lays roots in a triangle, as CSV.
int compare_roots(int count) {
  const strands::Mesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}};
  fmt::print("rule,roots,chi_square_of_64_cells,discrepancy\n");
  for (std::size_t rule = 0; rule < std::size(strands::k_root_rules); ++rule) {
    const auto placed = strands::place_roots(triangle, {.density = 2.0 * count, .rule = strands::RootRule(rule)});
    if (!placed) return report(placed.error());
    const strands::Evenness even = strands::evenness(placed->roots);
    fmt::print("{},{},{:.2f},{:.6f}\n", strands::k_root_rules[rule], placed->roots.size(), even.chi_square,
               even.discrepancy);
  }
  return Exit::ok;
}

int run(const GrowRequest& request, Context& context) {
  if (request.schema) {
    fmt::print("{}", strands::specification_schema());
    return Exit::ok;
  }
  if (request.compared_roots > 0) return compare_roots(request.compared_roots);
  if (!request.output.empty())
    if (const auto written = write_all(request, *context.progress); !written) return report(written.error());
  if (request.sheet.empty()) return Exit::ok;
  const auto drawn = draw_preset_sheet(request.specifications, request.sheet, context);
  return drawn ? int(Exit::ok) : report(drawn.error());
}

std::string parameters_help() {
  std::string text = table_help("growing: --set", registry::table_of<strands::Style>()) +
                     table_help("strands: --strands", registry::table_of<strands::StrandParameters>()) +
                     table_help("regions", registry::table_of<strands::Region>()) +
                     table_help("strokes", registry::table_of<strands::Stroke>()) +
                     table_help("bun", registry::table_of<strands::Bun>());
  for (const strands::Shaping* shaping : strands::shapings())
    text += table_help(fmt::format("shaping.{}", shaping->entry.name), shaping->entry.parameters);
  return text;
}

}  // namespace

void add_grow(CLI::App& app, Context& context) {
  auto* command =
      app.add_subcommand("grow", "grow hair on the procedural head; write it as a groom in metres, or draw it");
  command->footer(parameters_help);
  auto request = std::make_shared<GrowRequest>();
  auto* specification = command->add_option("specification", request->specifications,
                                            "grooming specifications (JSON); none: the defaults");
  command->add_option("--set", request->settings, "growing parameters as name=value,name=value")
      ->excludes(specification);
  command->add_option("--strands", request->strand_settings, "strand parameters as name=value,name=value")
      ->excludes(specification);
  command->add_option("--share", request->share, "level of detail: share of the strands")->check(CLI::Range(0.0, 1.0));
  command->add_option("--out", request->output, groom_help(true) + "; of several specifications: folder");
  command->add_flag("--control", request->control, "write the control hairs instead of the strands between them");
  command->add_option("--sheet", request->sheet, "picture to write: each specification from the front and from behind")
      ->needs(specification);
  command->add_flag("--schema", request->schema, "print the JSON Schema of grooming specifications instead");
  command->add_option("--compare-roots", request->compared_roots, "print how even N roots lie in a triangle, by rule")
      ->check(CLI::Range(1, 10000000));
  command->callback([&context, request] {
    if (request->output.empty() && request->sheet.empty() && !request->schema && request->compared_roots == 0)
      throw CLI::RequiredError("--out or --sheet");
    context.action = [&context, request] { return run(*request, context); };
  });
}

}  // namespace cuticle::cli
