// `cuticle sweep`: the package cuticle.sweeps runs the plan, here as on a cluster.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/shared_files.h"

namespace cuticle::cli {
namespace {

namespace fs = std::filesystem;

struct SweepOptions {
  std::string plan, out, shard, scheduler, table;
  int workers = 0, retries = 2, emit_commands = 0;
  double block_seconds = 2;
  bool dry_run = false;
};

/// Of `python -m cuticle.sweeps`, which runs in another folder.
std::vector<std::string> arguments_of(const SweepOptions& options, const Context& context) {
  std::vector<std::string> all = {
      fs::absolute(options.plan).string(), "--out",           fs::absolute(options.out).string(),      "--retries",
      std::to_string(options.retries),     "--block-seconds", fmt::format("{}", options.block_seconds)};
  const auto add = [&](const std::string& name, const std::string& value) {
    if (!value.empty()) all.insert(all.end(), {name, value});
  };
  add("--shard", options.shard);
  add("--scheduler", options.scheduler);
  add("--table", options.table.empty() ? "" : fs::absolute(options.table).string());
  add("--workers", options.workers > 0 ? std::to_string(options.workers) : "");
  add("--emit-commands", options.emit_commands > 0 ? std::to_string(options.emit_commands) : "");
  add("--threads", context.threads > 0 ? std::to_string(context.threads) : "");
  if (options.dry_run) all.emplace_back("--dry-run");
  if (context.json) all.emplace_back("--json");
  return all;
}

int sweep(const SweepOptions& options, const Context& context) {
  constexpr int cannot_start = 127;
  const int code = run_python("cuticle.sweeps", arguments_of(options, context));
  if (code != cannot_start) return code;
  return report(
      usage_error("sweep: no Python with the package 'cuticle' was found", "scripts/setup.sh, or CUTICLE_PYTHON_EXE"));
}

}  // namespace

void add_sweep(CLI::App& app, Context& context) {
  CLI::App* command =
      app.add_subcommand("sweep", "compute every combination of a plan's parameters; stopped, it goes on where it was");
  auto options = std::make_shared<SweepOptions>();
  command->add_option("plan", options->plan, "plan file: .json (docs/scale.md)")->required()->check(CLI::ExistingFile);
  command->add_option("--out", options->out, "folder of results; what is in it is not computed again")->required();
  command->add_option("--workers", options->workers, "processes on this machine; 0: one")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  command->add_option("--scheduler", options->scheduler, "address of a Dask scheduler, tcp://host:8786")
      ->excludes("--workers");
  command->add_option("--shard", options->shard, "I/N: every N-th item from the I-th, I from 1, for job arrays");
  command
      ->add_option("--emit-commands", options->emit_commands,
                   "print N commands that together compute the plan, and end")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--retries", options->retries, "of an item that fails")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  command
      ->add_option("--block-seconds", options->block_seconds,
                   "work handed out at once; of a process that is killed half of it may be lost")
      ->check(CLI::Range(0.01, 3600.0))
      ->capture_default_str();
  command->add_option("--table", options->table, "write the results so far: .parquet, .csv or .json");
  command->add_flag("--dry-run", options->dry_run, "print what would be computed, and end");
  command->callback([&context, options] { context.action = [&context, options] { return sweep(*options, context); }; });
}

}  // namespace cuticle::cli
