#include <algorithm>
#include <cstdio>

#include <fmt/core.h>

#include "cli/check/check.h"
#include "cli/model_options.h"
#include "study/model_check/registered.h"
#include "study/model_check/report.h"

namespace cuticle::cli {
namespace {

using study::model_check::Report;

struct ModelOptions {
  std::string name, precision = "f64";
  ParameterRequest parameters;
  bool variants = false;
  study::model_check::Options check;
};

Result<std::vector<const bsdf::Model*>> chosen_models(const std::string& name) {
  if (name == "all") return std::vector<const bsdf::Model*>(bsdf::models().begin(), bsdf::models().end());
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(name));
  return std::vector<const bsdf::Model*>{model};
}

Result<Report> check_variant(const bsdf::Model& model, const ModelOptions& options, const std::string& variant,
                             Progress& progress) {
  ParameterRequest request = options.parameters;
  if (!variant.empty()) request.settings += "," + variant;
  CUTICLE_ASSIGN(const registry::ParameterValues values, parameters_of(model, request));
  const bsdf::Precision precision = options.precision == "f32" ? bsdf::Precision::f32 : bsdf::Precision::f64;
  study::model_check::Subject subject = study::model_check::subject_of(model, values, precision);
  if (!variant.empty()) subject.name += " " + variant;
  subject.searched = !variant.empty();
  return check_subject(subject, study::model_check::exceptions_of(model, values), options.check, progress);
}

/// All reports; as text, each is printed as soon as it is there, because a model takes minutes.
Result<std::vector<Report>> check_models(const ModelOptions& options, const Context& context) {
  CUTICLE_ASSIGN(const std::vector<const bsdf::Model*> models, chosen_models(options.name));
  std::vector<Report> reports;
  for (const bsdf::Model* model : models) {
    std::vector<std::string> variants = study::model_check::variants_of(*model);
    if (!options.variants) variants.resize(1);
    for (const std::string& variant : variants) {
      CUTICLE_ASSIGN(Report report, check_variant(*model, options, variant, *context.progress));
      if (!context.json) {
        fmt::print("{}", to_text(report));
        std::fflush(stdout);
      }
      reports.push_back(std::move(report));
    }
  }
  return reports;
}

int check_model(const ModelOptions& options, const Context& context) {
  const Result<std::vector<Report>> reports = check_models(options, context);
  if (!reports) return report(reports.error());
  if (context.json) fmt::print("{}\n", study::model_check::to_json(*reports));
  if (!context.json && reports->size() > 1) fmt::print("\n{}", to_table(*reports));
  const bool sound = std::all_of(reports->begin(), reports->end(), [](const Report& one) { return one.sound(); });
  return sound ? Exit::ok : Exit::check_failed;
}

}  // namespace

void add_check_model(CLI::App& check, Context& context) {
  auto* command = check.add_subcommand(
      "model", "check energy, reciprocity, density, samples and tails of a fibre model, and that nothing is NaN");
  auto options = std::make_shared<ModelOptions>();
  command->add_option("model", options->name, "a model (cuticle models), or all")->required();
  add_parameter_options(*command, options->parameters);
  command->add_option("--precision", options->precision, "f32 or f64")
      ->check(CLI::IsMember({"f32", "f64"}))
      ->capture_default_str();
  command->add_option("--seed", options->check.seed, "of the samples and of the search for NaN")->capture_default_str();
  command->add_flag("--quick", options->check.quick, "fewer directions and samples");
  command->add_flag("--variants", options->variants,
                    "each variant of the model too: near field, as published, elliptical, ...");
  command->callback(
      [&context, options] { context.action = [&context, options] { return check_model(*options, context); }; });
}

}  // namespace cuticle::cli
