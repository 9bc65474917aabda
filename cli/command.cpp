#include "cli/command.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>

#include <fmt/core.h>
#include <tbb/global_control.h>

#include "cli/boundary.h"
#include "cli/suggest.h"
#include "core/interrupt.h"
#include "core/memory_limit.h"
#include "core/registry/former_names.h"
#include "core/text.h"

namespace cuticle::cli {

void add_all_commands(CLI::App& app, Context& context);

int report(const Error& error) {
  std::string text = "cuticle: error: " + printable(error.message) + "\n";
  if (!error.hint.empty()) text += "cuticle: try: " + printable(error.hint) + "\n";
  std::fwrite(text.data(), 1, text.size(), stderr);
  if (was_asked_to_stop()) return Exit::interrupted;
  switch (error.kind) {
    case ErrorKind::usage: return Exit::usage;
    case ErrorKind::bad_input: return Exit::bad_input_code;
    case ErrorKind::no_device:
    case ErrorKind::out_of_memory: return Exit::no_device;
    case ErrorKind::internal: break;
  }
  return Exit::internal;
}

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> parts(1);
  for (char c : text) {
    if (c == ',') parts.emplace_back();
    else parts.back() += c;
  }
  return parts;
}

namespace {

Result<double> parse_number(const std::string& name, const std::string& text) {
  double value = 0;
  auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return usage_error(fmt::format("{}: '{}' is not a number", name, text), "write a number, a list a,b,c or a range from:to:count");
  return value;
}

std::vector<std::string> split_range(const std::string& text) {
  std::vector<std::string> parts(1);
  for (char c : text) {
    if (c == ':') parts.emplace_back();
    else parts.back() += c;
  }
  return parts;
}

Result<std::vector<double>> parse_range(const std::string& name, const std::vector<std::string>& parts) {
  CUTICLE_ASSIGN(double from, parse_number(name, parts[0]));
  CUTICLE_ASSIGN(double to, parse_number(name, parts[1]));
  CUTICLE_ASSIGN(double count, parse_number(name, parts[2]));
  if (count < 1 || count > 1e7 || count != std::floor(count))
    return usage_error(fmt::format("{}: count {} of a range is outside 1 .. 10000000", name, parts[2]));
  std::vector<double> values(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = values.size() == 1 ? from : from + (to - from) * double(i) / double(values.size() - 1);
  return values;
}

}  // namespace

Result<std::vector<double>> parse_numbers(const std::string& name, const std::string& text) {
  std::vector<double> values;
  for (const std::string& part : split_list(text)) {
    const std::vector<std::string> range = split_range(part);
    if (range.size() == 3) {
      CUTICLE_ASSIGN(std::vector<double> more, parse_range(name, range));
      values.insert(values.end(), more.begin(), more.end());
    } else {
      CUTICLE_ASSIGN(double value, parse_number(name, part));
      values.push_back(value);
    }
  }
  return values;
}

Result<std::pair<int, int>> parse_frames(const std::string& text) {
  const std::vector<std::string> parts = split_range(text);
  if (parts.size() > 2) return usage_error(fmt::format("--frames: '{}' is not first:last", text));
  CUTICLE_ASSIGN(double first, parse_number("--frames", parts.front()));
  CUTICLE_ASSIGN(double last, parse_number("--frames", parts.back()));
  if (first < 0 || last < first || last > 1e6 || first != std::floor(first) || last != std::floor(last))
    return usage_error(fmt::format("--frames: '{}' must be whole numbers 0 <= first <= last <= 1000000", text));
  return std::pair<int, int>(int(first), int(last));
}

namespace {

/// Of "a=1,b=2,a=3", what is wrong with it; empty: nothing.
std::string names_given_twice(const std::string& settings) {
  std::set<std::string> names;
  for (const std::string& part : split_list(settings)) {
    std::string name = part.substr(0, part.find('='));
    std::erase(name, ' ');
    if (!name.empty() && !names.insert(name).second) return "'" + printable(name, 60) + "' is given twice";
  }
  return {};
}

/// Wherever settings are given: the last of two would win in silence.
void refuse_names_given_twice(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    if (option->check_lname("set") || option->check_lname("strands"))
      option->check(CLI::Validator(names_given_twice, "", "names once"));
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) refuse_names_given_twice(*command);
}

void say_former_name(std::string_view former, std::string_view now) {
  fmt::print(stderr, "cuticle: '{}' is called '{}' now; the next version no longer reads the former name\n", former, now);
}

}  // namespace

int run(int argc, char** argv) {
  registry::set_former_name_listener(say_former_name);
  CLI::App app{"Cuticle: hair reflectance and hair shadowing"};
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", "cuticle " CUTICLE_VERSION, "print the version");
  Context context;
  std::string progress = "auto";
  app.add_flag("--json", context.json, "print JSON instead of text");
  app.add_option("--device", context.device, "cpu, gpu, an index, or part of a device's name");
  app.add_option("--threads", context.threads, "CPU threads, 0 = all")->check(CLI::Range(0, 1024));
  app.add_option("--trace", context.trace_file, "write a Chrome trace (JSON) of the work to this file");
  app.add_option("--progress", progress, "auto, bar, json or none")->check(CLI::IsMember({"auto", "bar", "json", "none"}));
  std::string memory;
  app.add_option("--max-memory", memory, "most memory, such as 8G; what a file unfolds to is refused beyond it (default: half of the machine's)");
  add_all_commands(app, context);
  refuse_names_given_twice(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const std::optional<Error> misspelt = error.get_exit_code() == 0 ? std::nullopt : find_misspelt(app, argc, argv);
    if (misspelt) return report(*misspelt);
    return app.exit(error) == 0 ? Exit::ok : Exit::usage;
  }
  const ProgressStyle style = progress == "bar" ? ProgressStyle::bar : progress == "json" ? ProgressStyle::json
                              : progress == "none" ? ProgressStyle::silent : ProgressStyle::automatic;
  context.progress = make_progress(style);
  if (!memory.empty()) {
    const auto bytes = parse_memory(memory);
    if (!bytes) return report(bytes.error());
    if (const auto limited = limit_memory(*bytes); !limited) return report(limited.error());
  }
  std::optional<tbb::global_control> limit;
  if (context.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(context.threads));
  return context.action ? context.action() : Exit::usage;
}

}  // namespace cuticle::cli
