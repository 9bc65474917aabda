#include <fmt/core.h>

#include "cli/study/study.h"
#include "study/engine/compare.h"

namespace cuticle::cli {
namespace {

int study_compare(const std::string& a, const std::string& b, Context& context) {
  const auto comparison = study::compare_studies(a, b);
  if (!comparison) return report(comparison.error());
  fmt::print("{}", context.json ? study::to_json(*comparison).dump(1) + "\n" : study::to_text(*comparison));
  return study::has_regressions(*comparison) ? Exit::check_failed : Exit::ok;
}

}  // namespace

void add_study_compare(CLI::App& study, Context& context) {
  auto* command = study.add_subcommand(
      "compare", "two results side by side, machines and commits; names what became slower or less exact (exit code 1)");
  auto folders = std::make_shared<std::pair<std::string, std::string>>();
  command->add_option("a", folders->first, "folder of a study, or of all: what was")->required();
  command->add_option("b", folders->second, "folder: what is")->required();
  command->callback([&context, folders] {
    context.action = [&context, folders] { return study_compare(folders->first, folders->second, context); };
  });
}

}  // namespace cuticle::cli
