#include <fmt/core.h>

#include "cli/command.h"
#include "cli/groom_options.h"
#include "cli/parameter_help.h"
#include "cli/run_folder.h"
#include "core/file.h"
#include "strands/cards/hair_cards.h"

namespace cuticle::cli {

namespace {

struct CardsRequest {
  std::string groom, head, settings, out = "cards";
  strands::ReadOptions read;
  double head_metres_per_unit = 1;
};

Result<std::string> make_files(const CardsRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const auto parameters, registry::parse<strands::CardParameters>(request.settings));
  CUTICLE_ASSIGN(const strands::Groom groom, load_groom(request.groom, request.read, progress));
  strands::Mesh head;
  if (!request.head.empty()) {
    CUTICLE_ASSIGN(head, strands::read_obj(request.head, request.head_metres_per_unit));
  }
  CUTICLE_ASSIGN(const strands::HairCards cards, strands::make_hair_cards(groom, &head, parameters));
  CUTICLE_TRY(make_folder(request.out));
  CUTICLE_TRY(strands::write_cards(request.out, cards));
  return strands::card_report(cards);
}

int act(const CardsRequest& request, const Context& context) {
  const auto written = make_files(request, *context.progress);
  if (!written) return report(written.error());
  fmt::print("{}", *written);
  return Exit::ok;
}

}  // namespace

void add_cards(CLI::App& app, Context& context) {
  auto* command =
      app.add_subcommand("cards", "make hair cards of a groom: mesh (OBJ, glTF), textures (PNG), and what the cards lose");
  auto request = std::make_shared<CardsRequest>();
  command->add_option("groom", request->groom, groom_help(false))->required();
  command->add_option("--out", request->out, "folder to write (default: cards)");
  command->add_option("--head", request->head, "mesh that the hair grows on (OBJ): it shades the cards");
  command->add_option("--head-metres-per-unit", request->head_metres_per_unit, "scale of the head");
  command->add_option("--set", request->settings, "card parameters as name=value,name=value");
  add_groom_options(*command, request->read.metres_per_unit, request->read.radius);
  command->footer(
      [] { return table_help("--set (name, default, range, unit)", registry::table_of<strands::CardParameters>()); });
  command->callback([&context, request] {
    context.action = [&context, request] { return in_folder(request->out, [&] { return act(*request, context); }); };
  });
}

}  // namespace cuticle::cli
