#include <fmt/core.h>

#include "cli/study/study.h"
#include "study/skinning/twist_study.h"

namespace cuticle::cli {
namespace {

int study_skinning(const std::string& folder) {
  const study::TwistStudy twist = study::run_twist_study();
  const auto written = study::write_twist_study(twist, folder);
  if (!written) return report(written.error());
  fmt::print("{}", study::twist_csv(twist));
  return Exit::ok;
}

}  // namespace

void add_study_skinning(CLI::App& study, Context& context) {
  auto* command =
      study.add_subcommand("skinning", "a twisted tube: the volume that linear blend and dual quaternions keep");
  auto folder = std::make_shared<std::string>();
  command->add_option("--out", *folder, "folder to write")->required();
  command->callback([&context, folder] { context.action = [folder] { return study_skinning(*folder); }; });
}

}  // namespace cuticle::cli
