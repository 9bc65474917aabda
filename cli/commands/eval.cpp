#include <array>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "bsdf/model.h"
#include "bsdf/together.h"
#include "cli/command.h"
#include "cli/eval/coordinates.h"
#include "cli/eval/subjects.h"
#include "core/file.h"
#include "core/json/json.h"
#ifdef CUTICLE_HAS_GPU
#include "bsdf/model_gpu.h"
#endif

namespace cuticle::cli {
namespace {

struct EvalOptions {
  SubjectRequest subjects;
  CoordinateRequest coordinates;
  std::string lobes = "sum", precision = "f64", out;
  std::optional<int> together;  ///< times the model's paths
};

/// The values of one model and lobe at all points.
struct EvalSeries {
  std::string_view model;
  std::string lobe;
  std::vector<glm::dvec3> values;
};

Result<void> evaluate_on(const EvalOptions& options, const Context& context, const Subject& subject,
                         const bsdf::Request& request, std::span<glm::dvec3> out) {
  if (options.together) return bsdf::evaluate_together(*subject.model, subject.values, *options.together, request, out);
  if (options.precision != "gpu")
    return bsdf::evaluate(*subject.model, subject.values,
                          options.precision == "f32" ? bsdf::Precision::f32 : bsdf::Precision::f64, request, out);
#ifdef CUTICLE_HAS_GPU
  CUTICLE_ASSIGN(const std::shared_ptr<gpu::Device> device, gpu::Device::open({context.device}));
  return bsdf::evaluate_gpu(*device, *subject.model, subject.values, request, out);
#else
  static_cast<void>(context);
  return usage_error("--precision gpu: this build has no GPU kernels", "--precision f32");
#endif
}

Result<std::vector<EvalSeries>> evaluate_all(const EvalOptions& options, const Context& context,
                                             bsdf::Quantity quantity, const std::vector<Subject>& subjects,
                                             const std::vector<bsdf::Point>& points) {
  std::vector<EvalSeries> all;
  for (const Subject& subject : subjects)
    for (const std::string& lobe : split_list(options.lobes)) {
      CUTICLE_ASSIGN(const int index, bsdf::find_lobe(*subject.model, lobe));
      EvalSeries series{subject.model->entry.name, lobe, std::vector<glm::dvec3>(points.size())};
      CUTICLE_TRY(evaluate_on(options, context, subject, {quantity, index, points}, series.values));
      all.push_back(std::move(series));
    }
  return all;
}

/// The shortest text that reads back as the same number of the precision.
std::string in_digits(double value, const std::string& precision) {
  return precision == "f64" ? fmt::format("{}", value) : fmt::format("{}", float(value));
}

std::string csv(const EvalOptions& options, bool several, const PointsTable& table,
                const std::vector<EvalSeries>& all) {
  std::string text = several ? "model," : "";
  for (std::size_t column : table.columns) text += fmt::format("{},", eval_columns[column].name);
  text += "lobe,r,g,b\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (const EvalSeries& series : all) {
      if (several) text += fmt::format("{},", series.model);
      for (double value : table.rows[i]) text += fmt::format("{},", value);
      const glm::dvec3 rgb = series.values[i];
      text += fmt::format("{},{},{},{}\n", series.lobe, in_digits(rgb.x, options.precision),
                          in_digits(rgb.y, options.precision), in_digits(rgb.z, options.precision));
    }
  return text;
}

Json json_rows(const PointsTable& table, const std::vector<EvalSeries>& all) {
  Json rows = Json::list();
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (const EvalSeries& series : all) {
      const glm::dvec3 rgb = series.values[i];
      Json row = {{"model", series.model}, {"lobe", series.lobe}, {"r", rgb.x}, {"g", rgb.y}, {"b", rgb.z}};
      for (std::size_t c = 0; c < table.columns.size(); ++c)
        row[std::string(eval_columns[table.columns[c]].name)] = table.rows[i][c];
      rows.push_back(std::move(row));
    }
  return rows;
}

/// The rows; where a hair or a material was mapped, an object of the mappings and the rows.
std::string json(const std::vector<Subject>& subjects, const PointsTable& table, const std::vector<EvalSeries>& all) {
  Json mappings = Json::list();
  for (const Subject& subject : subjects)
    if (subject.mapping)
      mappings.push_back({{"model", subject.model->entry.name},
                          {"settings", subject.mapping->settings},
                          {"words", subject.mapping->words}});
  Json rows = json_rows(table, all);
  if (mappings.empty()) return rows.dump(1) + "\n";
  return Json{{"mappings", std::move(mappings)}, {"rows", std::move(rows)}}.dump(1) + "\n";
}

void print_mappings(const std::vector<Subject>& subjects) {
  for (const Subject& subject : subjects)
    if (subject.mapping)
      fmt::print(stderr, "{}: {}\n  {}\n", subject.model->entry.name, subject.mapping->settings,
                 subject.mapping->words);
}

Result<std::string> evaluated_text(const EvalOptions& options, const Context& context) {
  CUTICLE_ASSIGN(const bsdf::Quantity quantity, bsdf::find_quantity(options.coordinates.quantity));
  CUTICLE_ASSIGN(const std::vector<Subject> subjects, choose_subjects(options.subjects));
  CoordinateRequest request = options.coordinates;
  request.needed = needed_coordinates(subjects, quantity);
  request.refuse_unused = subjects.size() == 1;
  CUTICLE_ASSIGN(const PointsTable table, read_coordinates(request));
  if (all_below_pi(table))
    context.progress->message("eval: every angle is below 3.15: angles are in degrees here (0.5236 radians are 30)");
  print_mappings(subjects);
  CUTICLE_ASSIGN(const std::vector<EvalSeries> all,
                 evaluate_all(options, context, quantity, subjects, in_radians(table)));
  return context.json ? json(subjects, table, all) : csv(options, subjects.size() > 1, table, all);
}

int eval(EvalOptions options, const Context& context) {
  if (options.subjects.models.empty())
    options.subjects.models = options.subjects.material.empty() ? "marschner" : "chiang";
  const Result<std::string> text = evaluated_text(options, context);
  if (!text) return report(text.error());
  if (options.out.empty()) {
    fmt::print("{}", *text);
    return Exit::ok;
  }
  if (const auto written = write_text_file(options.out, *text); !written) return report(written.error());
  return Exit::ok;
}

void add_subject_options(CLI::App& command, SubjectRequest& request) {
  command.add_option("--model,--models", request.models, "models, a,b,c or all (cuticle models); default marschner");
  command.add_option("--set", request.settings,
                     "parameters, name=value,name=value, over preset, hair, material or defaults");
  command.add_option("--hair", request.hair,
                     "a whole fibre by name, mapped onto each model's parameters: blond, brown, black, red, ...");
  command.add_option("--preset", request.preset, "the pigment of blond, brown or black hair over the model's defaults");
  command.add_option("--material", request.material, "a MaterialX file (.mtlx) with a chiang_hair_bsdf");
  command.add_option("--pigments", request.absorption.pigments,
                     "sigma_a by TABLE:EUMELANIN/PHEOMELANIN; tables deon_pbrt, blender");
  command.add_option("--color", request.absorption.color,
                     "sigma_a by a colour r/g/b: assembly:r/g/b of dense hair, fibre:r/g/b of one fibre");
}

void add_coordinate_options(CLI::App& command, CoordinateRequest& request) {
  for (std::size_t c = 0; c < bsdf::coordinate_count; ++c)
    command.add_option(coordinate_flag(c), request.grid[c],
                       eval_columns[c].unit == "1" ? "offsets in fibre radii, a,b,c or from:to:count"
                                                   : "degrees, a,b,c or from:to:count");
  command.add_option("--points", request.points_file,
                     "CSV with columns theta_i, theta_o, theta_d, phi, phi_o (degrees), h");
}

}  // namespace

void add_eval(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("eval", "evaluate models at points or on a grid, as CSV; angles in degrees");
  auto options = std::make_shared<EvalOptions>();
  options->coordinates.quantity = "S";
  add_subject_options(*command, options->subjects);
  command->add_option("--quantity", options->coordinates.quantity, "S, M, N, A, albedo, pdf or error")
      ->capture_default_str();
  command->add_option("--lobe", options->lobes, "lobes of the model, or sum: R,TT,TRT,sum")->capture_default_str();
  add_coordinate_options(*command, options->coordinates);
  CLI::Option* precision = command->add_option("--precision", options->precision, "f32, f64 or gpu")
                               ->check(CLI::IsMember({"f32", "f64", "gpu"}))
                               ->capture_default_str();
  command
      ->add_option("--together", options->together,
                   "S of huang: the lights of each viewer together, by this many times its paths; many times faster")
      ->excludes(precision);
  command->add_option("--out", options->out, "write to this file instead of stdout");
  command->callback([&context, options] { context.action = [&context, options] { return eval(*options, context); }; });
}

}  // namespace cuticle::cli
