#include <vector>

#include <fmt/core.h>

#include <cuticle/bsdf/model.h>
#include <cuticle/cli/command.h>

namespace cuticle::cli {
namespace {

void print_conventions(const bsdf::Model& model) {
  const bsdf::Conventions& c = model.conventions;
  fmt::print("{}: {} field; cosine {}; absorption {}; roughness: {};\n  {}\n  presets:", model.entry.name, c.field,
             c.cosine, c.absorption, c.roughness, c.tilt_sign);
  for (const registry::StudyCase& preset : model.presets) fmt::print(" {} ({})", preset.name, preset.settings);
  fmt::print("\n");
}

int print_models(const Context& context) {
  std::vector<const registry::Entry*> entries;
  for (const bsdf::Model* model : bsdf::models()) entries.push_back(&model->entry);
  if (context.json) {
    fmt::print("{}\n", registry::to_json(entries));
    return Exit::ok;
  }
  fmt::print("{}\n", registry::to_text(entries));
  for (const bsdf::Model* model : bsdf::models()) print_conventions(*model);
  return Exit::ok;
}

}  // namespace

void add_models(CLI::App& app, Context& context) {
  CLI::App* command =
      app.add_subcommand("models", "the fibre scattering models, their parameters, presets and conventions");
  command->callback([&context] { context.action = [&context] { return print_models(context); }; });
}

}  // namespace cuticle::cli
