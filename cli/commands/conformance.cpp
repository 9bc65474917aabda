#include <filesystem>

#include <fmt/core.h>

#include "cli/command.h"
#include "cli/run_folder.h"
#include "cli/shared_files.h"
#include "core/file.h"
#include "study/conformance/conformance.h"

namespace cuticle::cli {

namespace {

namespace fs = std::filesystem;

/// Programs that an adapter is at hand for, and the one model of ours that each has.
struct Peer {
  std::string_view name, adapter, model;
};
constexpr Peer peers[] = {{"mitsuba", "mitsuba_hair.py", "chiang"}};

struct ConformanceRequest {
  std::vector<std::string> models;
  std::string out = "conformance", peer;
};

Result<void> copy_kit(const std::string& out) {
  for (const char* name : {"conformance.py", "cuticle_model.py", "mitsuba_hair.py", "README.md"}) {
    CUTICLE_ASSIGN(const std::string text, read_text_file(share_file(std::string("study/conformance/kit/") + name)));
    CUTICLE_TRY(write_text_file((fs::path(out) / name).string(), text));
  }
  return {};
}

Result<std::vector<const bsdf::Model*>> models_of(const ConformanceRequest& request) {
  std::vector<const bsdf::Model*> all;
  for (const Peer& peer : peers) {
    if (peer.name != request.peer) continue;
    CUTICLE_ASSIGN(all.emplace_back(), bsdf::find_model(peer.model));
  }
  if (!all.empty()) return all;
  for (const std::string& name : request.models) {
    CUTICLE_ASSIGN(all.emplace_back(), bsdf::find_model(name));
  }
  if (all.empty()) all.assign(bsdf::models().begin(), bsdf::models().end());
  return all;
}

Result<void> write_tables(const ConformanceRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const std::vector<const bsdf::Model*> models, models_of(request));
  CUTICLE_TRY(make_folder(request.out));
  CUTICLE_TRY(copy_kit(request.out));
  for (const bsdf::Model* model : models) {
    CUTICLE_ASSIGN(const std::vector<study::ConformanceRow> rows, study::conformance_rows(*model));
    const std::string file = (fs::path(request.out) / fmt::format("{}.csv", model->entry.name)).string();
    CUTICLE_TRY(write_text_file(file, study::conformance_csv(*model, rows)));
    progress.message(fmt::format("{}: {} values", file, rows.size()));
  }
  return {};
}

int act_conformance(const ConformanceRequest& request, const Context& context) {
  if (const auto written = write_tables(request, *context.progress); !written) return report(written.error());
  const fs::path folder = fs::absolute(request.out);
  for (const Peer& peer : peers)
    if (peer.name == request.peer)
      return run_script(folder / "conformance.py", {(folder / fmt::format("{}.csv", peer.model)).string(), "--with",
                                                    (folder / peer.adapter).string()});
  fmt::print("python {}/conformance.py {}/chiang.csv --with YOURS.py: see {}/README.md\n", request.out, request.out,
             request.out);
  return Exit::ok;
}

}  // namespace

void add_conformance(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand(
      "conformance", "write tables of the models' values with tolerances, and a script that holds yours against them");
  auto request = std::make_shared<ConformanceRequest>();
  std::vector<std::string> names, programs;
  for (const bsdf::Model* model : bsdf::models()) names.emplace_back(model->entry.name);
  for (const Peer& peer : peers) programs.emplace_back(peer.name);
  command->add_option("--model", request->models, "models to write, by commas (default: all)")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  command->add_option("--out", request->out, "folder to write (default: conformance)");
  command
      ->add_option("--for", request->peer,
                   "runs the table of the model that this program has against its Python package, where that is "
                   "installed")
      ->check(CLI::IsMember(programs));
  command->callback([&context, request] {
    context.action = [&context, request] {
      return in_folder(request->out, [&] { return act_conformance(*request, context); });
    };
  });
}

}  // namespace cuticle::cli
