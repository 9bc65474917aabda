#include <algorithm>

#include <fmt/core.h>

#include "cli/check/check.h"
#include "cli/groom_options.h"
#include "cli/usd_files.h"
#include "core/json/json.h"
#include "strands/check/groom_check.h"
#include "strands/refusals.h"

namespace cuticle::cli {
namespace {

Json to_json(const std::string& path, std::span<const strands::check::Verdict> verdicts, std::span<const strands::Refusal> refusals) {
  Json checks = Json::list(), refused = Json::list();
  for (const strands::check::Verdict& v : verdicts)
    checks.push_back({{"check", v.check},
                      {"passed", v.passed},
                      {"measured", v.measured},
                      {"mistake", v.mistake},
                      {"remedy", v.remedy}});
  for (const auto& [engine, what] : refusals) refused.push_back({{"engine", engine}, {"what", what}});
  return {{"file", path}, {"checks", checks}, {"refused_by", refused}};
}

void print(const strands::check::Verdict& verdict) {
  fmt::print("{:<12} {}   {}\n", verdict.check, verdict.passed ? "pass" : "FAIL", verdict.measured);
  if (!verdict.passed) fmt::print("{:<12}        {}: {}\n", "", verdict.mistake, verdict.remedy);
}

int check_groom(const std::string& path, const strands::ReadOptions& options, const Context& context) {
  const auto file = read_groom_file(path, options);
  if (!file) return report(file.error());
  const auto verdicts = strands::check::check_groom(file->groom);
  const std::vector<strands::Refusal> refusals = strands::refusals(file->groom);
  if (context.json) {
    fmt::print("{}\n", to_json(path, verdicts, refusals).dump(2));
  } else {
    for (const strands::check::Verdict& verdict : verdicts) print(verdict);
    for (const auto& [engine, what] : refusals) fmt::print("{:<12} refuses it: {}\n", engine, what);
  }
  return std::ranges::all_of(verdicts, &strands::check::Verdict::passed) ? Exit::ok : Exit::check_failed;
}

}  // namespace

void add_check_groom(CLI::App& check, Context& context) {
  auto* command = check.add_subcommand(
      "groom", "check units, widths, order and copies of a groom's strands; names the mistake of an export");
  auto path = std::make_shared<std::string>();
  auto options = std::make_shared<strands::ReadOptions>();
  command->add_option("file", *path, groom_help(false))->required();
  command->add_option("--metres-per-unit", options->metres_per_unit, "scale of the file; 0 = guess");
  command->add_option("--radius", options->radius, "fibre radius in metres; 0 = the file's own");
  command->callback([&context, path, options] {
    context.action = [&context, path, options] { return check_groom(*path, *options, context); };
  });
}

}  // namespace cuticle::cli
