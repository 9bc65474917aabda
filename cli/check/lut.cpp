#include <fmt/core.h>

#include "cli/check/check.h"
#include "lut/check/check.h"

namespace cuticle::cli {
namespace {

void print_verdict(const lut::check::TableVerdict& verdict) {
  if (verdict.passed) {
    fmt::print("{:<12} pass   {:.2g} of the tolerance, {}\n", verdict.table, verdict.misfit,
               verdict.unchanged ? "the file as it was written" : "a file written by another program");
    return;
  }
  fmt::print("{:<12} FAIL   {}: {}\n", verdict.table, verdict.mistake.name, verdict.mistake.evidence);
  if (!verdict.worst.empty()) fmt::print("{:<12}        {}\n", "", verdict.worst);
  fmt::print("{:<12}        {}\n", "", verdict.mistake.remedy);
}

int check_lut(const std::string& folder, const Context& context) {
  const auto checked = lut::check::check_folder(folder);
  if (!checked) return report(checked.error());
  if (context.json) {
    fmt::print("{}", lut::check::to_json(*checked));
  } else {
    fmt::print("{}: {} of {}, {}\n", folder, checked->layout, checked->model, checked->format);
    for (const lut::check::TableVerdict& verdict : checked->tables) print_verdict(verdict);
  }
  return checked->passed() ? Exit::ok : Exit::check_failed;
}

}  // namespace

void add_check_lut(CLI::App& check, Context& context) {
  auto* command =
      check.add_subcommand("lut", "compare a folder of tables with its manifest; names the mistake of an import");
  auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder, "folder with manifest.json and the tables")->required();
  command->callback(
      [&context, folder] { context.action = [&context, folder] { return check_lut(*folder, context); }; });
}

}  // namespace cuticle::cli
