#include <memory>
#include <vector>

#include <fmt/core.h>

#include "bsdf/listing/listing.h"
#include "bsdf/materialx/materialx.h"
#include "cli/command.h"
#include "cli/eval/subjects.h"
#include "core/file.h"

namespace cuticle::cli {
namespace {

struct ModelsOptions {
  SubjectRequest exported;  ///< models: the one to export; empty: list the models
  std::string out;
};

void print_model(const bsdf::Model& model) {
  const bsdf::Conventions& c = model.conventions;
  fmt::print("{}: {} field; cosine {}; absorption {}; roughness: {};\n  {}\n  lobes:", model.entry.name, c.field,
             c.cosine, c.absorption, c.roughness, c.tilt_sign);
  for (std::string_view lobe : model.lobes) fmt::print(" {}", lobe);
  fmt::print("\n  presets:");
  for (const registry::StudyCase& preset : model.presets) fmt::print(" {} ({})", preset.name, preset.settings);
  fmt::print("\n");
  for (const bsdf::Exception& exception : model.exceptions)
    fmt::print("  does not pass {}: {}\n", exception.check, exception.why);
}

int print_models(const Context& context) {
  if (context.json) {
    fmt::print("{}\n", bsdf::models_json());
    return Exit::ok;
  }
  std::vector<const registry::Entry*> entries;
  for (const bsdf::Model* model : bsdf::models()) entries.push_back(&model->entry);
  fmt::print("{}\n", registry::to_text(entries));
  for (const bsdf::Model* model : bsdf::models()) print_model(*model);
  return Exit::ok;
}

/// The model's parameters as a MaterialX document.
Result<void> export_model(const ModelsOptions& options) {
  if (options.exported.models != "chiang")
    return usage_error(
        fmt::format("--export {}: MaterialX has a node for the model chiang only", options.exported.models));
  if (options.out.empty()) return usage_error("--export needs --out FILE.mtlx");
  CUTICLE_ASSIGN(const std::vector<Subject> subjects, choose_subjects(options.exported));
  return write_text_file(options.out, bsdf::write_materialx(subjects[0].values));
}

int run(const ModelsOptions& options, const Context& context) {
  if (options.exported.models.empty()) return print_models(context);
  if (const auto written = export_model(options); !written) return report(written.error());
  return Exit::ok;
}

}  // namespace

void add_models(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand(
      "models", "the fibre scattering models, their parameters, presets, conventions and exceptions");
  auto options = std::make_shared<ModelsOptions>();
  command->add_option("--export", options->exported.models, "write a model's parameters as MaterialX: chiang");
  command->add_option("--set", options->exported.settings, "with --export: parameters, name=value,name=value");
  command->add_option("--preset", options->exported.preset, "with --export: a starting point of the model");
  command->add_option("--hair", options->exported.hair, "with --export: a fibre by name");
  command->add_option("--out", options->out, "with --export: the file, FILE.mtlx");
  command->callback([&context, options] { context.action = [&context, options] { return run(*options, context); }; });
}

}  // namespace cuticle::cli
