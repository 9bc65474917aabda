// What paths through hair cost: bench_reference [ROW ...]. Rows: dense (the head that bench/results/reference_peers.txt
// draws by other programs), bounces, colours, ambient (a Kajiya-Kay tracer's work), curves (every kind of curve: tree,
// memory, direct light), segments=N (memory of so many). CSV: wall clock and processor seconds, samples a second, mean
// radiance, standard error of the picture's mean luminance.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>

#include <fmt/core.h>
#include <sys/resource.h>
#include <tbb/info.h>
#include <glm/geometric.hpp>

#include "render/reference/reference.h"
#include "strands/growing/grow.h"
#include "strands/rays/ray_scene.h"

namespace {

using namespace cuticle;
using namespace cuticle::render::reference;

constexpr std::string_view k_blond = "sigma_a=0.06/0.1/0.2", k_brown = "sigma_a=0.3/0.5/0.8",
                           k_black = "sigma_a=1/1.5/2";

strands::Groom dense_head() {
  strands::GroomingSpecification specification;
  specification.strands.density = 4e5;
  strands::Groom hair = strands::grow(specification).value().drawn;
  for (float& radius : hair.radii) radius = 8e-5f;
  return hair;
}

TracedScene scene_of(strands::Groom hair, std::string_view model, std::string_view settings) {
  TracedScene scene;
  scene.hair = std::move(hair);
  scene.model = bsdf::find_model(model).value();
  scene.values = bsdf::parse_settings(*scene.model, "", settings).value();
  scene.lights = {{.name = "sun", .to_light = glm::normalize(glm::dvec3(0.6, 0.9, 0.8)), .irradiance = glm::dvec3(10)}};
  scene.camera.position = {0.42, 0.2, 1};
  scene.camera.target = {0, 0.06, 0};
  scene.camera.vertical_field_of_view = 27 * std::numbers::pi / 180;
  scene.camera.resolution = {320, 320};
  return scene;
}

std::string chiang(std::string_view color) { return fmt::format("{},beta_m=0.3,beta_n=0.3,alpha=0", color); }

class Watch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(); }
  double processor_seconds() const { return double(std::clock() - processor_) / CLOCKS_PER_SEC; }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t processor_ = std::clock();
};

double mean_of(const Image& image, int channel) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += double(image.at(x, y, channel));
  return sum / (image.width * image.height);
}

/// Of the mean of a picture's luminance, relative: channels of a path rise and fall together.
double error_of(const Image& layers) {
  double variance = 0;
  for (int y = 0; y < layers.height; ++y)
    for (int x = 0; x < layers.width; ++x) {
      const auto error = [&](int c) { return std::sqrt(double(layers.at(x, y, 4 + c))); };
      const double luminance = 0.2126 * error(0) + 0.7152 * error(1) + 0.0722 * error(2);
      variance += luminance * luminance;
    }
  const double mean = 0.2126 * mean_of(layers, 0) + 0.7152 * mean_of(layers, 1) + 0.0722 * mean_of(layers, 2);
  return std::sqrt(variance) / (layers.width * layers.height) / mean;
}

void print_row(std::string_view name, const TracedScene& scene, int bounces, int samples,
               strands::CurveKind curves = {}) {
  Watch watch;
  const auto tracer = Tracer::make(scene, {.curves = curves}).value();
  const double build = watch.seconds();
  watch = {};
  const Picture picture =
      trace_picture(scene, {.scatterings = bounces, .curves = curves}, {.samples = samples}, silent_progress()).value();
  const double paths = double(samples) * scene.camera.resolution.x * scene.camera.resolution.y;
  const double processor = watch.processor_seconds();
  fmt::print("{},{},{},{:.2f},{:.2f},{:.3g},{:.5f},{:.5f},{:.5f},{:.2e},{:.2f},{:.1f}\n", name, bounces, samples,
             picture.seconds, processor, paths / processor, mean_of(picture.color, 0), mean_of(picture.color, 1),
             mean_of(picture.color, 2), error_of(picture.layers), build, double(tracer->memory_bytes()) / (1 << 20));
  std::fflush(stdout);
}

/// One shadow ray and one to the surroundings from every fibre that the camera sees.
void print_ambient(const strands::Groom& hair) {
  TracedScene scene = scene_of(hair, "kajiya_kay", "");
  Image white = make_image(2, 1, {"R", "G", "B"});
  std::ranges::fill(white.pixels, 1.0f);
  scene.surroundings = {std::move(white)};
  scene.camera.resolution = {1280, 720};
  print_row("kajiya_kay and surroundings", scene, 1, 8);
}

/// The same curve as that of Catmull and Rom through a strand's points, ends as strands/curve_kind.h has them.
strands::Groom bezier_of(const strands::Groom& hair) {
  strands::Groom bezier;
  for (std::size_t s = 0; s < hair.strand_count(); ++s) {
    const auto points = hair.strand(s);
    const std::size_t last = points.size() - 1;
    const auto half_chord = [&](std::size_t k) {
      const glm::vec3 before = k > 0 ? points[k - 1] : 2.0f * points[0] - points[1];
      const glm::vec3 after = k < last ? points[k + 1] : 2.0f * points[last] - points[last - 1];
      return (after - before) / 6.0f;
    };
    for (std::size_t k = 0; k < last; ++k)
      bezier.positions.insert(bezier.positions.end(),
                              {points[k], points[k] + half_chord(k), points[k + 1] - half_chord(k + 1)});
    bezier.positions.push_back(points[last]);
    bezier.offsets.push_back(std::uint32_t(bezier.positions.size()));
  }
  bezier.radii.assign(bezier.positions.size(), hair.radii[0]);
  return bezier;
}

/// Direct light and all light of one head by every kind of curve.
void print_curves(const strands::Groom& hair) {
  for (const std::string_view name : strands::curve_kind_names()) {
    const strands::CurveKind kind = strands::curve_kind(name);
    const TracedScene scene =
        scene_of(kind.basis == strands::SplineBasis::bezier ? bezier_of(hair) : hair, "chiang", chiang(k_blond));
    for (const int bounces : {1, 0}) print_row(name, scene, bounces, 8, kind);
  }
}

/// Even fibres of a lawn, and what the process held at most.
void print_segments(std::uint64_t wanted) {
  strands::Groom hair;
  constexpr std::uint64_t k_points = 21;
  const std::uint64_t strands = wanted / (k_points - 1), side = std::uint64_t(std::sqrt(double(strands))) + 1;
  for (std::uint64_t s = 0; s < strands; ++s) {
    for (std::uint64_t i = 0; i < k_points; ++i)
      hair.positions.emplace_back(0.2f * float(s % side) / float(side), 0.01f * float(i),
                                  0.2f * float(s / side) / float(side));
    hair.offsets.push_back(std::uint32_t(hair.positions.size()));
  }
  hair.radii.assign(hair.positions.size(), 4e-5f);
  TracedScene scene = scene_of(std::move(hair), "chiang", chiang(k_blond));
  print_row(fmt::format("{} segments", strands * (k_points - 1)), scene, 0, 1);
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  fmt::print("# most memory of the process: {:.2f} GiB\n", double(used.ru_maxrss) / (1 << 20));
}

void print_rows(std::string_view row) {
  if (row.starts_with("segments=")) return print_segments(std::stoull(std::string(row.substr(9))));
  const strands::Groom hair = dense_head();
  const TracedScene blond = scene_of(hair, "chiang", chiang(k_blond));
  if (row == "dense") print_row("dense head", blond, 0, 64);
  if (row == "quick") print_row("dense head", blond, 0, 8);
  if (row == "bounces")
    for (const int bounces : {1, 2, 4, 8, 16, 32, 0}) print_row("blond", blond, bounces, 8);
  if (row == "colours") {
    print_row("brown", scene_of(hair, "chiang", chiang(k_brown)), 0, 8);
    print_row("black", scene_of(hair, "chiang", chiang(k_black)), 0, 8);
  }
  if (row == "ambient") print_ambient(hair);
  if (row == "curves") print_curves(hair);
}

}  // namespace

int main(int count, char** arguments) {
  fmt::print("# threads: {}\n", tbb::info::default_concurrency());
  fmt::print(
      "row,bounces,samples,seconds,processor_seconds,samples_per_processor_second,red,green,blue,relative_error,"
      "tree_seconds,tree_MiB\n");
  for (int k = 1; k < count; ++k) print_rows(arguments[k]);
  return 0;
}
