#include <fmt/core.h>

#include "cli/command.h"
#include "cli/groom_options.h"
#include "cli/usd_files.h"

namespace cuticle::cli {

namespace {

struct ConvertRequest {
  std::string input, output;
  strands::ReadOptions read;
  double output_metres_per_unit = 0;  ///< 0: the format's own
};

int convert(const ConvertRequest& request, Progress& progress) {
  const auto file = read_groom_file(request.input, request.read);
  if (!file) return report(file.error());
  for (const std::string& note : file->notes) progress.message(request.input + ": " + note);
  const auto lost = write_groom_file(request.output, file->groom, request.output_metres_per_unit);
  if (!lost) return report(lost.error());
  for (const std::string& note : *lost) progress.message(request.output + ": " + note);
  progress.message(fmt::format("{}: {} strands, {} vertices written", request.output, file->groom.strand_count(),
                               file->groom.vertex_count()));
  return Exit::ok;
}

}  // namespace

void add_convert(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand("convert", "convert a groom to another format; says what that format cannot hold");
  auto request = std::make_shared<ConvertRequest>();
  command->add_option("input", request->input, groom_help(false))->required();
  command->add_option("output", request->output, groom_help(true))->required();
  command->add_option("--metres-per-unit", request->read.metres_per_unit, "scale of the input; 0 = guess");
  command->add_option("--radius", request->read.radius, "fibre radius in metres; 0 = the input's own");
  command->add_flag("--repair", request->read.repair,
                    "mend points that are NaN or coincide, strands of one point or no length");
  command->add_option("--output-metres-per-unit", request->output_metres_per_unit,
                      "scale of the output; 0 = metres, in .abc centimetres");
  command->callback(
      [&context, request] { context.action = [&context, request] { return convert(*request, *context.progress); }; });
}

}  // namespace cuticle::cli
