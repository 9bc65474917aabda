#include <algorithm>

#include <fmt/core.h>

#include "cli/abc_files.h"
#include "cli/check/check.h"
#include "cli/groom_options.h"
#include "cli/usd_files.h"
#include "core/json/json.h"
#include "strands/check/groom_check.h"
#include "strands/refusals.h"

namespace cuticle::cli {
namespace {

Json to_json(const std::string& path, std::span<const strands::check::Verdict> verdicts,
             std::span<const strands::Refusal> refusals, std::span<const strands::Refusal> missing) {
  Json checks = Json::list(), refused = Json::list();
  for (const strands::check::Verdict& v : verdicts)
    checks.push_back({{"check", v.check},
                      {"passed", v.passed},
                      {"measured", v.measured},
                      {"mistake", v.mistake},
                      {"remedy", v.remedy}});
  for (const auto& [engine, what] : refusals) refused.push_back({{"engine", engine}, {"what", what}});
  Json filled_in = Json::list();
  for (const auto& [engine, what] : missing) filled_in.push_back({{"engine", engine}, {"what", what}});
  return {{"file", path}, {"checks", checks}, {"refused_by", refused}, {"filled_in_by", filled_in}};
}

void print(const strands::check::Verdict& verdict) {
  fmt::print("{:<12} {}   {}\n", verdict.check, verdict.passed ? "pass" : "FAIL", verdict.measured);
  if (!verdict.passed) fmt::print("{:<12}        {}: {}\n", "", verdict.mistake, verdict.remedy);
}

struct CheckGroomRequest {
  std::string path;
  strands::ReadOptions options;
  std::vector<std::string> importers;  ///< empty: what every one refuses is said, and is no failure
};

/// Of the importers asked for.
std::vector<strands::Refusal> asked_for(std::vector<strands::Refusal> all, const std::vector<std::string>& importers) {
  if (!importers.empty())
    std::erase_if(all, [&](const strands::Refusal& refusal) {
      return std::ranges::find(importers, refusal.engine) == importers.end();
    });
  return all;
}

struct Findings {
  std::vector<strands::Refusal> refusals, missing;
};

/// Of a groom and, where the file is Alembic and Unreal is asked for, of its schema.
Result<Findings> findings_of(const std::string& path, const strands::Groom& groom,
                             const std::vector<std::string>& importers) {
  Findings found{asked_for(strands::refusals(groom), importers), {}};
  if (importers.empty()) return found;
  if (!is_abc(path) || std::ranges::find(importers, "unreal") == importers.end()) {
    found.missing = asked_for(strands::missing(groom), importers);
    return found;
  }
  CUTICLE_ASSIGN(AbcSchema schema, check_abc(path));
  found.refusals.insert(found.refusals.end(), schema.refuses.begin(), schema.refuses.end());
  found.missing = std::move(schema.fills_in);
  return found;
}

int check_groom(const CheckGroomRequest& request, const Context& context) {
  const std::string& path = request.path;
  const auto file = read_groom_file(path, request.options);
  if (!file) return report(file.error());
  const auto verdicts = strands::check::check_groom(file->groom);
  const auto findings = findings_of(path, file->groom, request.importers);
  if (!findings) return report(findings.error());
  const auto& [refusals, missing] = *findings;
  if (context.json) {
    fmt::print("{}\n", to_json(path, verdicts, refusals, missing).dump(2));
  } else {
    for (const strands::check::Verdict& verdict : verdicts) print(verdict);
    for (const auto& [engine, what] : refusals) fmt::print("{:<12} refuses it: {}\n", engine, what);
    for (const auto& [engine, what] : missing) fmt::print("{:<12} takes it with {}\n", engine, what);
    for (const std::string& importer : request.importers)
      if (std::ranges::find(refusals, importer, &strands::Refusal::engine) == refusals.end())
        fmt::print("{:<12} refuses nothing that is known\n", importer);
  }
  const bool holds = std::ranges::all_of(verdicts, &strands::check::Verdict::passed);
  return holds && (request.importers.empty() || refusals.empty()) ? Exit::ok : Exit::check_failed;
}

}  // namespace

void add_check_groom(CLI::App& check, Context& context) {
  auto* command = check.add_subcommand(
      "groom", "check units, widths, order and copies of a groom's strands; names the mistake of an export");
  auto request = std::make_shared<CheckGroomRequest>();
  command->add_option("file", request->path, groom_help(false))->required();
  command
      ->add_option(
          "--for", request->importers,
          "programs that it is meant for, by commas: what they refuse fails the check, what they fill in is said")
      ->delimiter(',')
      ->check(
          CLI::IsMember(std::vector<std::string>(std::begin(strands::k_importers), std::end(strands::k_importers))));
  command->add_option("--metres-per-unit", request->options.metres_per_unit, "scale of the file; 0 = guess");
  command->add_option("--radius", request->options.radius, "fibre radius in metres; 0 = the file's own");
  command->callback(
      [&context, request] { context.action = [&context, request] { return check_groom(*request, context); }; });
}

}  // namespace cuticle::cli
