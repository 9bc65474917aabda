#include "cli/model_options.h"
#include "cli/view/view.h"

namespace cuticle::cli {
namespace {

struct TablesOptions : ViewOptions {
  std::string folder, model = "marschner", layout{lut::k_best_layout}, table;
  ParameterRequest parameters;
  int size_texels = 128;
};

Result<lut::TableSet> set_of(const TablesOptions& options, Progress& progress) {
  if (!options.folder.empty()) return viz::read_tables(options.folder);
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(options.model));
  CUTICLE_ASSIGN(const registry::ParameterValues values, parameters_of(*model, options.parameters));
  CUTICLE_ASSIGN(const lut::Layout* layout, lut::find_layout(options.layout, *model, values));
  return lut::bake(*model, values, *layout, options.size_texels, progress);
}

Result<void> view_tables(const TablesOptions& options, Context& context) {
  viz::TablesView view;
  CUTICLE_ASSIGN(view.set, set_of(options, *context.progress));
  view.table = options.table;
  return show_or_write(
      options, [&](const std::string& folder) { return viz::write_tables(view.set, folder); },
      [&](const viz::Views& views, const viz::ViewTarget& target) { return views.tables(view, target); });
}

}  // namespace

void add_view_lut(CLI::App& view, Context& context) {
  auto options = std::make_shared<TablesOptions>();
  CLI::App* command =
      view.add_subcommand("lut", "lookup tables as images and height fields, beside their error against the model");
  command->add_option("folder", options->folder, "tables that `bake` wrote; without: baked now");
  command->add_option("--model", options->model, "the model to bake (cuticle models)")->capture_default_str();
  add_parameter_options(*command, options->parameters);
  command->add_option("--layout", options->layout, "layout to bake")->capture_default_str();
  command->add_option("--texels", options->size_texels, "size to bake")
      ->check(CLI::Range(16, 1024))
      ->capture_default_str();
  command->add_option("--table", options->table, "which table; without: the first");
  add_target_options(*command, *options);
  set_view_action(*command, context, options, view_tables);
}

}  // namespace cuticle::cli
