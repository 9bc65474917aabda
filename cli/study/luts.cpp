#include <fmt/core.h>

#include "cli/run_folder.h"
#include "cli/shared_files.h"
#include "cli/study/study.h"
#include "study/luts/luts_study.h"

namespace cuticle::cli {
namespace {

struct LutsOptions {
  std::string models = "marschner", layouts, settings, out;
  bool quick = false;
};

study::LutsRequest request_of(const LutsOptions& options) {
  study::LutsRequest request;
  request.models = split_list(options.models);
  request.settings = options.settings;
  if (!options.layouts.empty()) request.layouts = split_list(options.layouts);
  if (!options.quick) return request;
  request.sizes = {16, 64};
  request.formats = {"exr", "png8"};
  request.fits = {"none"};
  request.points = 512;
  request.repeats = 5;
  return request;
}

int study_luts(const LutsOptions& options, Context& context) {
  const auto luts = study::run_luts_study(request_of(options), *context.progress);
  if (!luts) return report(luts.error());
  const auto written = study::write_luts_study(*luts, options.out);
  if (!written) return report(written.error());
  if (context.json)
    fmt::print("{}", study::to_json(*luts));
  else
    print_rows(study::to_csv(*luts), options.out + "/study.csv");
  return make_page("", options.out, *context.progress);
}

}  // namespace

void add_study_luts(CLI::App& study, Context& context) {
  auto* command = study.add_subcommand("luts", "lookup tables beside the model: error against bytes and time");
  auto options = std::make_shared<LutsOptions>();
  command->add_option("--out", options->out, "folder to write")->required();
  command->add_option("--models", options->models, "models, a,b,c")->capture_default_str();
  command->add_option("--layouts", options->layouts, "layouts, a,b,c; without it all whose tables make S");
  command->add_option("--set", options->settings, "parameters of every model, name=value,name=value");
  command->add_flag("--quick", options->quick, "fewer sizes, formats and timings, no fits");
  command->callback([&context, options] {
    context.action = [&context, options] {
      return in_folder(options->out, [&] { return study_luts(*options, context); });
    };
  });
}

}  // namespace cuticle::cli
