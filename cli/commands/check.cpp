#include "cli/check/check.h"

namespace cuticle::cli {

void add_check(CLI::App& app, Context& context) {
  auto* check = app.add_subcommand("check", "check a model, tables, a groom, a scene or the device; names what is wrong");
  check->require_subcommand(1);
  check->fallthrough();
  add_check_device(*check, context);
  add_check_groom(*check, context);
  add_check_lut(*check, context);
  add_check_model(*check, context);
  add_check_scene(*check, context);
}

}  // namespace cuticle::cli
