#include "cli/command.h"
#include "cli/run_folder.h"

#include <charconv>
#include <memory>

#include <fmt/format.h>

#include "cli/model_options.h"
#include "core/json/json.h"
#include "lut/fit/analytic_fit.h"
#include "lut/fit/texel_fit.h"
#include "lut/format.h"
#include "lut/max_error.h"
#include "lut/table_set.h"
#include "lut/target.h"
#ifdef CUTICLE_HAS_GPU
#include "lut/bake_gpu.h"
#endif

namespace cuticle::cli {
namespace {

struct BakeOptions {
  std::string model = "marschner", layout = "auto", format = "exr", processor = "cpu", fit = "none",
              max_error, max_error_kind = "rms", targets, out;
  ParameterRequest parameters;
  int size = 128;
  bool size_is_given = false, format_is_given = false;
};

Result<lut::TableSet> bake_on(const BakeOptions& options, const Context& context, const bsdf::Model& model,
                              const registry::ParameterValues& values, const lut::Layout& layout) {
  if (options.processor == "cpu") return lut::bake(model, values, layout, options.size, *context.progress);
#ifdef CUTICLE_HAS_GPU
  CUTICLE_ASSIGN(const std::shared_ptr<gpu::Device> device, gpu::Device::open({context.device}));
  return lut::bake_gpu(*device, model, values, layout, options.size);
#else
  return usage_error("--on: this build has no GPU kernels", "--on cpu");
#endif
}

/// A certified set, with what fitting its texels changed.
struct Baked {
  lut::TableSet set;
  std::vector<lut::ChannelFit> fits;
  double fit_ms = 0;
};

Result<Baked> certify_or_fit(const BakeOptions& options, const lut::Format& format, const Context& context,
                             lut::TableSet set) {
  if (options.fit == "texels") {
    CUTICLE_ASSIGN(lut::TexelFit fit, lut::fit_texels(set, format, *context.progress));
    return Baked{std::move(fit.set), std::move(fit.channels), fit.fit_ms};
  }
  CUTICLE_TRY(lut::certify(set, format, *context.progress));
  return Baked{std::move(set), {}, 0};
}

Result<Baked> make_tables(const BakeOptions& options, const lut::Format& format, const Context& context) {
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(options.model));
  CUTICLE_ASSIGN(const registry::ParameterValues values,
                 parameters_of(*model, options.parameters));
  CUTICLE_ASSIGN(const lut::Layout* layout, lut::find_layout(options.layout, *model, values));
  CUTICLE_ASSIGN(const std::vector<const lut::Target*> targets, lut::find_targets(options.targets));
  CUTICLE_ASSIGN(lut::TableSet set, bake_on(options, context, *model, values, *layout));
  CUTICLE_ASSIGN(Baked baked, certify_or_fit(options, format, context, std::move(set)));
  CUTICLE_TRY(lut::write(baked.set, format, options.out, targets));
  return baked;
}

void print_error(const lut::ChannelError& e, std::string_view words) {
  fmt::print("{:<14}{:>11.3e}{:>11.3e}{:>11.3e}{:>11.3e}{:>11.2e}{:>11.2e}{:>11.2e}{:>10.1f}%{}\n", e.channel,
             e.maximum, e.rms, e.percentile_99, e.peak, lut::relative_error(e.maximum, e.peak),
             lut::relative_error(e.rms, e.signal_rms), lut::relative_error(e.in_angle.rms, e.in_angle.signal_rms),
             100 * e.excluded, words);
}

void print_errors(const lut::TableSet& set, const std::string& out) {
  fmt::print("{:<14}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}\n", "channel", "max", "rms", "p99", "peak",
             "max/peak", "rms/rms", "in angle", "left out");
  for (const lut::Table& table : set.tables)
    for (const lut::ChannelError& e : table.errors) print_error(e, "");
  for (const lut::ChannelError& e : set.assumption) print_error(e, "  from exact channels");
  for (const lut::ChannelError& e : set.scattering) print_error(e, "  from the tables");
  fmt::print("{} of {}, {}x{}, baked on {} in {:.0f} ms, in {}\n", set.layout->entry.name, set.model->entry.name,
             set.size, set.size, set.baked_on, set.bake_ms, out);
}

/// What to do with the folder now.
void print_next_steps(const BakeOptions& options) {
  if (options.targets.empty())
    fmt::print("next: add --target unity,godot,unreal,three for a folder for each engine, with a README of three steps\n");
  for (const std::string& target : options.targets.empty() ? std::vector<std::string>() : split_list(options.targets))
    fmt::print("next: {}/{}/README.md, three steps\n", options.out, target);
  fmt::print("      {}/preview.png shows the tables; cuticle check lut {} says whether a copy still reads right\n",
             options.out, options.out);
}

/// Relative errors of the samples and of the fitted texels side by side.
void print_gains(const Baked& baked) {
  fmt::print("\n{:<14}{:>20}{:>11}{:>11}{:>20}{:>11}\n", "fitted texels", "samples rms/rms", "fitted", "gain",
             "samples max/peak", "fitted");
  for (const auto& [name, samples, fitted, kept] : baked.fits)
    fmt::print("{:<14}{:>20.2e}{:>11.2e}{:>11.2f}{:>20.2e}{:>11.2e}{}\n", name,
               lut::relative_error(samples.rms, samples.signal_rms), lut::relative_error(fitted.rms, fitted.signal_rms),
               lut::relative_error(samples.rms, fitted.rms), lut::relative_error(samples.maximum, samples.peak),
               lut::relative_error(fitted.maximum, fitted.peak), kept ? "" : "  samples kept");
  fmt::print("fitted in {:.0f} ms\n", baked.fit_ms);
}

std::string layout_names() {
  std::vector<std::string_view> names = {"auto: the one that loses least of S"};
  for (const lut::Layout* layout : lut::layouts()) names.push_back(layout->entry.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// "1%" or "0.01".
Result<double> parse_error_limit(const std::string& text) {
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end, std::size_t(text.data() + text.size() - end));
  if (unit == "%") value /= 100;
  if (code == std::errc() && (unit.empty() || unit == "%") && value > 0 && value < 1) return value;
  return usage_error(fmt::format("--max-error: '{}' is not between 0 and 100%", text), "--max-error 1%");
}

/// The layouts of one family, along other axes; the sizes and formats that the command line leaves open.
Result<lut::TableChoices> table_choices(const BakeOptions& options, const bsdf::Model& model,
                                        const registry::ParameterValues& values) {
  lut::TableChoices choices;
  CUTICLE_ASSIGN(const lut::Layout* named, lut::find_layout(options.layout, model, values));
  for (const lut::Layout* layout : lut::layouts())
    if (layout->family == named->family) choices.layouts.push_back(layout);
  for (int size = 16; size <= 1024; size *= 2) choices.sizes.push_back(size);
  if (options.size_is_given) choices.sizes = {options.size};
  CUTICLE_ASSIGN(choices.formats.emplace_back(), lut::find_format(options.format));
  if (!options.format_is_given) {
    CUTICLE_ASSIGN(choices.formats.emplace_back(), lut::find_format("png8"));
  }
  return choices;
}

Result<lut::ErrorSearch> search(const BakeOptions& options, const Context& context) {
  CUTICLE_ASSIGN(const double wanted, parse_error_limit(options.max_error));
  CUTICLE_ASSIGN(const lut::ErrorMeasure measure, lut::find_error_measure(options.max_error_kind));
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(options.model));
  CUTICLE_ASSIGN(const registry::ParameterValues values,
                 parameters_of(*model, options.parameters));
  CUTICLE_ASSIGN(const lut::TableChoices choices, table_choices(options, *model, values));
  return lut::search_tables(*model, values, choices, wanted, measure, *context.progress);
}

std::string words_of(const lut::TableChoice& choice) {
  return fmt::format("{} {}x{} {}, {} bytes: {:.2e} ({})", choice.layout->entry.name, choice.size, choice.size,
                     choice.format->name, choice.bytes, choice.worst.error, choice.worst.name);
}

Json json_of(const lut::TableChoice& choice) {
  return {{"layout", choice.layout->entry.name}, {"size", choice.size},
          {"format", choice.format->name},       {"bytes", choice.bytes},
          {"error", choice.worst.error},         {"channel", choice.worst.name}};
}

constexpr std::string_view error_words(lut::ErrorMeasure measure) {
  if (measure == lut::ErrorMeasure::maximum) return "largest error over largest value";
  if (measure == lut::ErrorMeasure::percentile_99)
    return "99th percentile of the error over the largest value, every direction alike";
  return "rms error over rms value, every direction alike";
}

void print_failure(const BakeOptions& options, const lut::ErrorSearch& search, bool json) {
  if (json) {
    Json out{{"reached", false}, {"best", json_of(search.best)}, {"not_tried", search.stopped}};
    for (const lut::TableChoice& choice : search.tried) out["tried"].push_back(json_of(choice));
    fmt::print("{}\n", out.dump(2));
    return;
  }
  for (const lut::TableChoice& choice : search.tried) fmt::print("{}\n", words_of(choice));
  for (const std::string& words : search.stopped) fmt::print("not tried: {}\n", words);
  fmt::print("none reaches {}; best: {}; nothing written\n", options.max_error, words_of(search.best));
}

int bake_as_given(const BakeOptions& options, const Context& context) {
  const auto format = lut::find_format(options.format);
  if (!format) return report(format.error());
  const auto baked = make_tables(options, **format, context);
  if (!baked) return report(baked.error());
  if (context.json)
    fmt::print("{}", lut::manifest_json(baked->set, **format));
  else
    print_errors(baked->set, options.out);
  if (!context.json && !baked->fits.empty()) print_gains(*baked);
  if (!context.json) print_next_steps(options);
  return Exit::ok;
}

Result<lut::AnalyticFit> make_analytic(const BakeOptions& options, const Context& context) {
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(options.model));
  CUTICLE_ASSIGN(const registry::ParameterValues values,
                 parameters_of(*model, options.parameters));
  CUTICLE_ASSIGN(lut::AnalyticFit fit, lut::fit_analytic(*model, values, *context.progress));
  CUTICLE_TRY(lut::write(fit, options.out));
  return fit;
}

int bake_analytic(const BakeOptions& options, const Context& context) {
  const auto fit = make_analytic(options, context);
  if (!fit) return report(fit.error());
  if (context.json) {
    fmt::print("{}", lut::to_json(*fit));
    return Exit::ok;
  }
  fmt::print("{:<6}{:>12}{:>12}{:>12}{:>12}\n", "lobe", "N rms/rms", "max/peak", "M rms/rms", "max/peak");
  for (const lut::AnalyticLobe& lobe : fit->lobes)
    fmt::print("{:<6}{:>12.2e}{:>12.2e}{:>12.2e}{:>12.2e}\n", lobe.name, lobe.n.rms, lobe.n.maximum, lobe.m.rms,
               lobe.m.maximum);
  fmt::print("shader code of {} without textures, in {}\n", options.model, options.out);
  return Exit::ok;
}

/// Chooses axes, size and format first where an error is wanted.
int bake(BakeOptions options, const Context& context) {
  if (options.fit == "analytic") return bake_analytic(options, context);
  if (options.max_error.empty()) return bake_as_given(options, context);
  const auto found = search(options, context);
  if (!found) return report(found.error());
  const lut::ErrorMeasure measure = *lut::find_error_measure(options.max_error_kind);
  if (!context.json)
    fmt::print("wanted: {} of the worst channel at most {}\n", error_words(measure), options.max_error);
  if (!found->reached) {
    print_failure(options, *found, context.json);
    return Exit::check_failed;
  }
  options.layout = found->best.layout->entry.name;
  options.size = found->best.size;
  options.format = found->best.format->name;
  if (!context.json) fmt::print("chosen: {}\n", words_of(found->best));
  return bake_as_given(options, context);
}

}  // namespace

void add_bake(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("bake", "bake lookup textures of a model, with their measured error");
  auto options = std::make_shared<BakeOptions>();
  command->add_option("--model", options->model, "a model (cuticle models)")->capture_default_str();
  add_parameter_options(*command, options->parameters);
  command->add_option("--layout", options->layout, layout_names())->capture_default_str();
  command->add_option("--size", options->size, "texels each way, 16 .. 1024")->capture_default_str();
  command->add_option(
      "--max-error", options->max_error,
      "such as 1%: choose axes, size (unless given) and format (unless given), the fewest bytes that reach "
      "it; exit code 1 and nothing written where none does");
  command
      ->add_option("--max-error-kind", options->max_error_kind,
                   "rms (over rms), max or p99 (over the peak), of the worst channel and of S")
      ->capture_default_str();
  command->add_option("--format", options->format, "exr, ktx2 or dds (half), png8 or png16")->capture_default_str();
  command->add_option("--target", options->targets, "engines to write a folder for, with a hair material: unity,godot,unreal,three; babylon,playcanvas with --format ktx2");
  command->add_option("--on", options->processor, "cpu or gpu")
      ->check(CLI::IsMember({"cpu", "gpu"}))
      ->capture_default_str();
  command
      ->add_option(
          "--fit", options->fit,
          "none: samples of the model; texels: least squares after the filter; analytic: shader code without textures")
      ->check(CLI::IsMember({"none", "texels", "analytic"}))
      ->capture_default_str();
  command->add_option("--out", options->out, "folder to write")->required();
  command->callback([&context, options, command] {
    options->size_is_given = command->count("--size") > 0;
    options->format_is_given = command->count("--format") > 0;
    context.action = [&context, options] { return in_folder(options->out, [&] { return bake(*options, context); }); };
  });
}

}  // namespace cuticle::cli
