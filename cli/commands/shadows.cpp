#include <algorithm>
#include <limits>

#include <fmt/core.h>

#include "cli/groom_options.h"
#include "cli/shadow_cut.h"
#include "cli/shared_files.h"
#include "core/file.h"
#include "core/json/json.h"
#include "core/points/points_file.h"
#include "shadows/channels.h"
#include "shadows/footprint.h"
#include "shadows/light_frame.h"
#include "study/shadows/comparison.h"
#ifdef CUTICLE_HAS_GPU
#include "study/shadows/device_cost.h"
#endif

namespace cuticle::cli {
namespace {

struct ShadowsOptions {
  std::string groom, light = "1,1,0.3", methods = "none,opacity_map", layers, resolutions, filters, filter_texels,
                     spacings, settings, points, out, alpha_rgb, camera, weights = "at_vertices";
  strands::ReadOptions read;
  study::Request request;
  double alpha = 0.4, footprint_mm = 0;
  int rays = 1024;
  std::size_t receivers = 2000;
  ShadowCut cut;
  bool quick = false, flicker = false, on_device = false;
};

Result<glm::dvec3> parse_direction(const std::string& name, const std::string& text) {
  CUTICLE_ASSIGN(const std::vector<double> numbers, parse_numbers(name, text));
  if (numbers.size() != 3)
    return usage_error(fmt::format("{}: '{}' has {} numbers, not 3", name, text, numbers.size()), name + " 1,1,0.3");
  return glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

Result<std::vector<std::int64_t>> parse_integers(const std::string& name, const std::string& text) {
  if (text.empty()) return std::vector<std::int64_t>{};
  CUTICLE_ASSIGN(const std::vector<double> numbers, parse_numbers(name, text));
  std::vector<std::int64_t> integers;
  for (const double number : numbers) {
    if (number < 0 || number > 1e9 || number != double(std::int64_t(number)))
      return usage_error(fmt::format("{}: {} is not a whole number in the range of the methods", name, number),
                         "cuticle methods");
    integers.push_back(std::int64_t(number));
  }
  return integers;
}

/// Lookups' filters in metres; 0, and none given, is the truth's footprint.
Result<std::vector<double>> parse_filters(const std::string& text, double footprint) {
  if (text.empty()) return std::vector<double>{footprint};
  CUTICLE_ASSIGN(std::vector<double> radii, parse_numbers("--filter", text));
  for (double& radius : radii) {
    if (!(radius >= 0 && radius <= 1000))
      return usage_error(fmt::format("--filter: {} is outside 0 .. 1000 mm", radius), "--filter 0,2,5");
    radius = radius > 0 ? 1e-3 * radius : footprint;
  }
  return radii;
}

Result<study::Sweep> parse_sweep(const ShadowsOptions& options, double footprint) {
  study::Sweep sweep;
  CUTICLE_ASSIGN(sweep.layers, parse_integers("--layers", options.layers));
  CUTICLE_ASSIGN(sweep.resolutions, parse_integers("--resolution", options.resolutions));
  if (options.filter_texels.empty()) {
    CUTICLE_ASSIGN(sweep.filter_radii, parse_filters(options.filters, footprint));
  } else {
    CUTICLE_ASSIGN(sweep.filter_texels, parse_numbers("--filter-texels", options.filter_texels));
  }
  if (!options.spacings.empty()) sweep.spacings = split_list(options.spacings);
  if (!options.settings.empty()) {
    CUTICLE_ASSIGN(sweep.settings, study::parse_method_settings(split_list(options.settings)));
  }
  sweep.skip_unfit = options.methods == "all" || !options.camera.empty();
  return sweep;
}

std::vector<std::string> method_names(const ShadowsOptions& options) {
  return options.methods == "all" ? study::all_methods() : split_list(options.methods);
}

Result<std::optional<glm::dvec3>> camera_of(const ShadowsOptions& options) {
  if (options.camera.empty()) return std::optional<glm::dvec3>();
  CUTICLE_ASSIGN(const glm::dvec3 to_camera, parse_direction("--camera", options.camera));
  CUTICLE_ASSIGN(const glm::dvec3 direction, shadows::unit_to_light(to_camera));
  return std::optional<glm::dvec3>(direction);
}

/// What a camera sees are points.
double footprint_of(const ShadowsOptions& options, const strands::Groom& groom,
                    const std::optional<glm::dvec3>& to_camera = {}) {
  if (options.footprint_mm > 0) return 1e-3 * options.footprint_mm;
  return to_camera ? 0 : shadows::default_footprint_radius(groom);
}

/// With a camera, what is not given is what pictures use: a filter of one texel, and resolutions to compare.
ShadowsOptions with_defaults(ShadowsOptions options) {
  if (options.camera.empty()) return options;
  if (options.filters.empty() && options.filter_texels.empty()) options.filter_texels = "1";
  if (options.resolutions.empty()) options.resolutions = "128,256,512,1024";
  return options;
}

/// Rays start from a disc of some strand spacings, which nobody gave: without this check its size would be refused.
Result<void> check_spacing(const ShadowsOptions& options, const strands::Groom& groom) {
  constexpr double most = 1;  // metre
  const double footprint = footprint_of(options, groom);
  if (footprint <= most || options.footprint_mm > 0) return {};
  const FarStrand far = farthest_strand(groom);
  return bad_input(
      fmt::format("{}: four strand spacings are {:.3g} m, allowed at most {} m: strand {} reaches {:.3g} m "
                  "from the middle of the groom",
                  options.groom, footprint, most, far.strand, far.distance),
      "take that strand out, or state the groom's unit by --metres-per-unit");
}

Result<std::vector<glm::vec3>> read_positions(const std::string& path) {
  constexpr double most = 1e6;
  constexpr PointColumn columns[] = {{"x", -most, most, "m"}, {"y", -most, most, "m"}, {"z", -most, most, "m"}};
  CUTICLE_ASSIGN(const PointsTable table, read_points(path, columns));
  if (table.columns.size() != 3)
    return bad_input(fmt::format("{}: line 1: columns x, y and z are needed", path), "x,y,z");
  std::vector<glm::vec3> points(table.rows.size());
  for (std::size_t row = 0; row < points.size(); ++row)
    for (std::size_t column = 0; column < 3; ++column)
      points[row][int(table.columns[column])] = float(table.rows[row][column]);
  return points;
}

std::string column_name(const study::Candidate& candidate, bool alone) {
  std::string settings = alone ? "" : ":" + study::settings_text(candidate);
  std::replace(settings.begin(), settings.end(), ',', ';');
  return std::string(candidate.method->entry.name) + settings;
}

/// The truth of a table of points: rays and footprint as asked for.
Result<void> set_truth(const ShadowsOptions& options, double footprint, std::vector<study::Candidate>& candidates) {
  for (study::Candidate& candidate : candidates) {
    if (candidate.method->entry.name != "truth") continue;
    const std::string set = fmt::format("rays={},footprint_radius_mm={:.17g}", options.rays, 1e3 * footprint);
    CUTICLE_ASSIGN(candidate.values, registry::parse_assignments(candidate.method->entry.parameters, set));
  }
  return {};
}

using Columns = std::vector<std::vector<float>>;
void print_points(const std::vector<std::string>& names, std::span<const glm::vec3> points, const Columns& columns) {
  fmt::print("x,y,z");
  for (const std::string& name : names) fmt::print(",{}", name);
  for (std::size_t i = 0; i < points.size(); ++i) {
    fmt::print("\n{},{},{}", points[i].x, points[i].y, points[i].z);
    for (const auto& column : columns) fmt::print(",{:.6g}", column[i]);
  }
  fmt::print("\n");
}

/// A candidate's transmittance at the points: one column, or one for each of three opacities.
Result<Columns> evaluate_columns(const study::Candidate& candidate, const shadows::Casters& casters,
                                 std::span<const glm::vec3> points, const std::optional<glm::dvec3>& opacities) {
  if (!opacities) {
    CUTICLE_ASSIGN(auto result, candidate.method->evaluate(casters, {points}, candidate.values));
    return Columns{std::move(result.values)};
  }
  CUTICLE_ASSIGN(const auto result,
                 shadows::evaluate_channels(*candidate.method, casters, *opacities, {points}, candidate.values));
  Columns columns(3);
  for (const glm::vec3& value : result.values)
    for (int channel = 0; channel < 3; ++channel) columns[std::size_t(channel)].push_back(value[channel]);
  return columns;
}

/// The methods of --at and --cut, truth among them where it is asked for.
Result<std::vector<study::Candidate>> candidates_at_points(const ShadowsOptions& options, const strands::Groom& groom) {
  const double footprint = footprint_of(options, groom);
  CUTICLE_ASSIGN(const study::Sweep sweep, parse_sweep(options, footprint));
  CUTICLE_ASSIGN(auto candidates, study::candidates_of(method_names(options), sweep));
  CUTICLE_TRY(set_truth(options, footprint, candidates));
  return candidates;
}

Result<int> draw_plane(const ShadowsOptions& options, const shadows::Casters& casters) {
  CUTICLE_ASSIGN(const auto candidates, candidates_at_points(options, *casters.groom));
  CUTICLE_TRY(draw_cut(options.cut, casters, candidates));
  return int(Exit::ok);
}

Result<int> print_at_points(const ShadowsOptions& options, const shadows::Casters& casters) {
  CUTICLE_ASSIGN(const std::vector<glm::vec3> points, read_positions(options.points));
  CUTICLE_ASSIGN(const auto candidates, candidates_at_points(options, *casters.groom));
  std::optional<glm::dvec3> opacities;
  if (!options.alpha_rgb.empty()) {
    CUTICLE_ASSIGN(opacities, parse_direction("--alpha-rgb", options.alpha_rgb));
  }
  std::vector<std::string> names;
  Columns columns;
  for (const study::Candidate& candidate : candidates) {
    CUTICLE_ASSIGN(Columns of_candidate, evaluate_columns(candidate, casters, points, opacities));
    std::move(of_candidate.begin(), of_candidate.end(), std::back_inserter(columns));
    const auto same = std::count_if(candidates.begin(), candidates.end(),
                                    [&](const auto& other) { return other.method == candidate.method; });
    const std::string name = column_name(candidate, same == 1);
    for (const char* channel : {".R", ".G", ".B"})
      if (opacities) names.push_back(name + channel);
    if (!opacities) names.push_back(name);
  }
  print_points(names, points, columns);
  return int(Exit::ok);
}

study::Weights weights_of(const std::string& name) {
  return name == "per_fragment"       ? study::Weights::per_fragment
         : name == "per_vertex"       ? study::Weights::per_vertex
         : name == "tents_per_vertex" ? study::Weights::tents_per_vertex
                                      : study::Weights::at_vertices;
}

constexpr std::size_t k_quick_receivers = 300;

Result<study::Comparison> compare(const ShadowsOptions& options, const shadows::Casters& casters, Progress& progress) {
  study::ComparisonRequest request;
  request.groom_name = options.groom;
  request.groom = casters.groom;
  request.alpha = casters.alpha;
  request.to_light = casters.to_light;
  CUTICLE_ASSIGN(request.to_camera, camera_of(options));
  request.footprint_radius = footprint_of(options, *casters.groom, request.to_camera);
  request.rays = options.rays;
  request.weights = weights_of(options.weights);
  request.flicker = options.flicker;
  request.receivers = options.quick ? std::min(options.receivers, k_quick_receivers) : options.receivers;
  std::vector<std::string> methods = method_names(options);
  std::erase(methods, "truth");  // computed in any case, as what the others are compared with
  CUTICLE_ASSIGN(const study::Sweep sweep, parse_sweep(with_defaults(options), request.footprint_radius));
  CUTICLE_ASSIGN(request.candidates, study::candidates_of(methods, sweep));
  for (const std::string& sentence : study::left_out_of(methods, sweep)) progress.message(sentence);
  return study::compare_with_truth(request, progress);
}

/// Times on the device that --device chooses.
Result<void> measure_device(const shadows::Casters& casters, Context& context, study::Comparison& comparison) {
#ifdef CUTICLE_HAS_GPU
  CUTICLE_ASSIGN(auto device, gpu::Device::open({.choice = context.device}));
  return study::measure_on_device(std::move(device), casters, *context.progress, comparison);
#else
  (void)casters, (void)context, (void)comparison;
  return usage_error("--on-device: this build has no Vulkan", "configure with CUTICLE_GPU=ON");
#endif
}

std::string row_text(const study::ComparisonRow& row) {
  return fmt::format("{} {}: mean error {:.4f} +- {:.4f}, {:.3g} ms, {} bytes", row.method, row.settings,
                     row.error.mean, row.error.mean_interval, row.total_ms, row.cost.bytes);
}

/// What meets the request, or what comes nearest and why it does not.
struct BudgetVerdict {
  const study::ComparisonRow* choice = nullptr;
  study::Nearest nearest;
  std::string text() const {
    if (choice != nullptr) return row_text(*choice);
    return fmt::format("none does: nearest is {}, because {}", row_text(*nearest.row), nearest.because);
  }
};
BudgetVerdict judge(const study::Comparison& comparison, const study::Request& request) {
  BudgetVerdict verdict{study::best_choice(comparison, request), {}};
  if (verdict.choice == nullptr) verdict.nearest = study::nearest_to(comparison, request);
  return verdict;
}

/// The study's JSON with the choice, and what was asked for.
std::string json_with_choice(const study::Comparison& comparison, const study::Request& request,
                             const BudgetVerdict& verdict) {
  auto object = Json::parse(study::to_json(comparison)).value();
  const auto index = [&](const study::ComparisonRow* row) { return std::size_t(row - comparison.rows.data()); };
  object["request"] = {{"max_error", request.max_error}, {"budget_ms", request.budget_ms}};
  object["choice"] = nullptr;
  if (verdict.choice != nullptr)
    object["choice"] = object["rows"][index(verdict.choice)];
  else
    object["nearest"] = object["rows"][index(verdict.nearest.row)];
  object["verdict"] = verdict.text();
  return object.dump(2) + "\n";
}

/// The exit code of the page.
Result<int> write_all(const ShadowsOptions& options, const study::Comparison& comparison, const std::string& json,
                      Progress& progress) {
  CUTICLE_TRY(study::write_comparison(comparison, options.out));
  CUTICLE_TRY(write_text_file(options.out + "/study.json", json));
  return make_page("", options.out, progress);
}

Result<int> run(const ShadowsOptions& options, Context& context) {
  CUTICLE_ASSIGN(const glm::dvec3 to_light, parse_direction("--light", options.light));
  CUTICLE_ASSIGN(const strands::Groom groom, load_groom(options.groom, options.read, *context.progress));
  CUTICLE_TRY(check_spacing(options, groom));
  const shadows::Casters casters{&groom, options.alpha, to_light};
  if (!options.points.empty()) return print_at_points(options, casters);
  if (!options.cut.file.empty()) return draw_plane(options, casters);
  CUTICLE_ASSIGN(study::Comparison comparison, compare(options, casters, *context.progress));
  if (options.on_device) CUTICLE_TRY(measure_device(casters, context, comparison));
  for (const study::Refusal& refusal : comparison.refused)
    context.progress->message(fmt::format("{} {}: refused: {}", refusal.method, refusal.settings, refusal.why));
  const BudgetVerdict verdict = judge(comparison, options.request);
  const std::string json = json_with_choice(comparison, options.request, verdict);
  fmt::print("{}", context.json ? json : study::to_csv(comparison));
  int page = Exit::ok;
  if (!options.out.empty()) {
    CUTICLE_ASSIGN(page, write_all(options, comparison, json, *context.progress));
  }
  if (options.request.max_error <= 0 && options.request.budget_ms <= 0) return page;
  fmt::print(stderr, "{}\n", verdict.text());
  return verdict.choice == nullptr ? int(Exit::check_failed) : page;
}

void add_options(CLI::App& command, ShadowsOptions& options) {
  const double infinity = std::numeric_limits<double>::infinity();
  command.add_option("groom", options.groom, groom_help(false))->required();
  command.add_option("--light", options.light, "direction from the scene to the light, x,y,z");
  command.add_option("--methods", options.methods, "a,b,c of `cuticle methods`, or all");
  command.add_option("--layers", options.layers, "slices or layers of the methods that have them, a,b,c");
  command.add_option("--resolution", options.resolutions, "resolutions of the methods that have one, a,b,c");
  command.add_option("--filter", options.filters, "radii that lookups average, mm, a,b,c; 0 = the footprint's");
  command.add_option("--filter-texels", options.filter_texels, "the same in texels of each map, a,b,c")
      ->excludes("--filter");
  command.add_option("--spacing", options.spacings, "spacings of the layers of the methods that have them, a,b,c");
  command.add_option("--set", options.settings,
                     "other parameters of the methods, METHOD.NAME=VALUE,.. (cuticle methods lists them)");
  command
      .add_option("--footprint-mm", options.footprint_mm,
                  "radius that the truth is averaged over; 0 = two fibre spacings, with --camera none")
      ->check(CLI::Range(0.0, 1000.0));
  command.add_option("--alpha", options.alpha, "opacity of one fibre crossing")->check(CLI::Range(0.0, 1.0));
  add_groom_options(command, options.read.metres_per_unit, options.read.radius);
  command.add_option("--rays", options.rays, "rays of the truth for each point; one with --camera")
      ->check(CLI::Range(1, 65536));
  command
      .add_option(
          "--weights", options.weights,
          "at_vertices; or in the middle of segments, looked up there (per_fragment), from both ends (per_vertex) or "
          "with tent weights of planes from both ends (tents_per_vertex); with --camera, these where pixels see hair")
      ->check(CLI::IsMember({"at_vertices", "per_fragment", "per_vertex", "tents_per_vertex"}));
  command.add_option(
      "--camera", options.camera,
      "direction to an orthographic camera, x,y,z: compare what its pixels see, not vertices, with filters of one "
      "texel and resolutions 128,256,512,1024 unless given");
  command.add_flag("--flicker", options.flicker,
                   "measure the change of the error as the light turns by 0.1 degree and hair moves by 0.1 texel too");
  command.add_flag("--on-device", options.on_device, "time the methods' passes on the Vulkan device too");
  command.add_flag("--quick", options.quick, "at most 300 receivers");
  command.add_option("--receivers", options.receivers, "strand vertices that are compared")
      ->check(CLI::Range(1, 1000000));
  command
      .add_option("--budget-ms", options.request.budget_ms,
                  "milliseconds for build and lookup at every vertex, at most")
      ->check(CLI::Range(0.0, infinity));
  command.add_option("--max-error", options.request.max_error, "mean error of transmittance, at most")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--at", options.points,
                     "CSV with columns x,y,z in metres: print each method's transmittance there");
  command
      .add_option("--alpha-rgb", options.alpha_rgb,
                  "with --at: the opacity for red, green and blue light, a,b,c; a column each")
      ->needs("--at");
  command
      .add_option("--cut", options.cut.file,
                  "PNG: draw each method's transmittance on a plane through the hair's middle, the light above it")
      ->excludes("--at");
  command.add_option("--cut-size", options.cut.size, "width and height of each method's picture there, pixels")
      ->check(CLI::Range(16, 4096));
  command.add_option("--out", options.out, "folder for study.json, study.csv, receivers.csv and the page");
}

}  // namespace

void add_shadows(CLI::App& app, Context& context) {
  auto* command =
      app.add_subcommand("shadows", "compare shadow methods on a groom with ray-traced truth: error, time, bytes");
  auto options = std::make_shared<ShadowsOptions>();
  add_options(*command, *options);
  command->callback([&context, options] {
    context.action = [&context, options] {
      const auto code = run(*options, context);
      return code ? *code : report(code.error());
    };
  });
}

}  // namespace cuticle::cli
