#include "cli/view/view.h"

namespace cuticle::cli {

void add_view(CLI::App& app, Context& context) {
  CLI::App* command =
      app.add_subcommand("view", "lobes, tables, strands and shadows in a window, a picture or a movie");
  command->require_subcommand(1);
  command->fallthrough();
  add_view_lobes(*command, context);
  add_view_paths(*command, context);
  add_view_lut(*command, context);
  add_view_strands(*command, context);
  add_view_shadow(*command, context);
  add_view_plan(*command, context);
}

}  // namespace cuticle::cli
