// Fits the corrections of dual scattering to path tracing: fit_multiple_scattering TABLE.cpp FOLDER ... [--held FOLDER
// ...]. Each folder is one that samples.cpp wrote; those behind --held are only judged. Prints light and errors of
// each, and writes the tables that bsdf/dual_scattering compiles, of hair alone and on a head; without pictures of one
// it stays as it is compiled. With --judge the errors of the compiled ones alone. --direction-spread R: in place
// of the pass's default, radians. Equations are means over 8 x 8 pixels.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include <fmt/core.h>
#include <fmt/os.h>
#include <glm/common.hpp>

#include "bsdf/dual_scattering/corrections.h"
#include "bsdf/dual_scattering/scattered_light.glslh"
#include "lut/fit/positive_fit.h"

namespace {

using namespace cuticle;
using namespace cuticle::bsdf::dual_scattering;

constexpr int k_side = 8, k_rows = 32, k_seen = 7, k_light = 9;
constexpr double k_pi = 3.141592653589793;

/// Smoothing, and the weight of a picture's mean beside all its squares: chosen by --leave-out.
struct Weights {
  double bend = 1, slope = 0.06, pull = 0.2, mean = 2;
};

/// terms.f64, and the spread of the fibres' directions, radians (direction_spread of render/passes/dual_scattering).
struct Terms {
  std::vector<double> numbers;
  double direction_spread = 0.4;
};

template <class T>
std::vector<T> read(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) {
    fmt::print(stderr, "{}: cannot be read\n", path);
    std::exit(3);
  }
  std::vector<T> values(std::size_t(file.tellg()) / sizeof(T));
  file.seekg(0).read(reinterpret_cast<char*>(values.data()), std::streamsize(values.size() * sizeof(T)));
  return values;
}

/// What each factor adds to a block's light at each depth and angle: angles innermost.
using Parts = std::array<glm::dvec3, k_factors * k_depths * k_angles>;
constexpr std::size_t place_of_part(int factor, int depth, int angle) {
  return std::size_t((factor * k_depths + depth) * k_angles + angle);
}

/// One picture by one shadow method: its light in blocks, and what adds to them.
struct Case {
  std::string name, groom;
  int method = 0, methods = 1;
  int across = 0, blocks = 0;
  double thickness = 0;
  Within within = Within::hair_alone;
  glm::dvec3 albedo{0};
  std::vector<glm::dvec3> direct, multiple, variance;
  std::vector<char> lit;
  std::vector<Parts> parts;  ///< of each block
};

ScatteringLobe<double> lobe_of(const Terms& terms, int lobe, double theta, int channel) {
  const double at = std::clamp((theta / k_pi + 0.5) * k_rows - 0.5, 0.0, k_rows - 1.0);
  const int below = std::min(int(at), k_rows - 2);
  const auto term = [&](int which) {
    const auto place = [&](int row) { return terms.numbers[std::size_t((row * 9 + lobe + which) * 3 + channel)]; };
    return std::lerp(place(below), place(below + 1), at - below);
  };
  return {term(0), term(1), term(2)};
}

/// As dual_scattering.glsl puts them together, of one channel: onward, back, diffuse, per irradiance.
std::array<double, k_factors> factors_at(const Terms& terms, const float* seen, double arrives, int channel) {
  const double theta_i = std::asin(std::clamp(double(seen[1]), -1.0, 1.0)),
               theta_o = std::asin(std::clamp(double(seen[2]), -1.0, 1.0)), theta_d = (theta_o - theta_i) / 2;
  const double away = std::acos(std::clamp(double(seen[3]), -1.0, 1.0)) / k_pi;
  const FibreAverages<double> fibre{lobe_of(terms, 0, theta_i, channel), lobe_of(terms, 0, theta_d, channel),
                                    lobe_of(terms, 3, theta_d, channel), lobe_of(terms, 6, theta_d, channel)};
  const double transmittance = std::clamp(arrives, double(k_min_transmittance), 1.0);
  const ScatteredLight<double> light =
      scattered_light(fibre, transmittance, theta_i, theta_o, away, terms.direction_spread * terms.direction_spread);
  const double inclined = std::cos(theta_i) / (k_pi * std::max(std::cos(theta_d) * std::cos(theta_d), 1e-3));
  return {inclined * light.onward, inclined * (light.back + light.onward_back), 1 / (4 * k_pi)};
}

void add_light(Case& picture, const std::vector<float>& light, int width) {
  const int rows = int(light.size()) / k_light / width;
  for (int y = 0; y < rows / k_side * k_side; ++y)
    for (int x = 0; x < picture.across * k_side; ++x) {
      const auto block = std::size_t(y / k_side * picture.across + x / k_side);
      const float* pixel = light.data() + std::size_t(y * width + x) * k_light;
      for (int c = 0; c < 3; ++c) {
        picture.direct[block][c] += double(pixel[c]) / (k_side * k_side);
        picture.multiple[block][c] += double(pixel[3 + c]) / (k_side * k_side);
        picture.variance[block][c] += double(pixel[6 + c]) / std::pow(k_side, 4);
      }
    }
}

/// The cosine of the angle between light and eye.
double toward(const float* seen) {
  const double sin_i = double(seen[1]), sin_o = double(seen[2]);
  return sin_i * sin_o +
         std::sqrt(std::max(1 - sin_i * sin_i, 0.0) * std::max(1 - sin_o * sin_o, 0.0)) * double(seen[3]);
}

/// What a ray's vertex adds to its block: `tiles` shades vertices and draws what lies between them.
void add_vertex(Parts& parts, const Terms& terms, const float* seen, double arrives, double unit) {
  const Between depth = between_depths(arrives), angle = between_angles(toward(seen));
  for (int c = 0; c < 3; ++c) {
    const auto factors = factors_at(terms, seen, arrives, c);
    for (int f = 0; f < k_factors; ++f)
      for (int corner = 0; corner < 4; ++corner) {
        const int dd = corner / 2, da = corner % 2;
        const double share = (dd ? depth.share : 1 - depth.share) * (da ? angle.share : 1 - angle.share);
        parts[place_of_part(f, depth.below + dd, angle.below + da)][c] += unit * factors[std::size_t(f)] * share;
      }
  }
}

void add_parts(Case& picture, const Terms& terms, const std::vector<float>& seen, int width, double unit) {
  for (std::size_t k = 0; k < seen.size(); k += std::size_t(k_seen + 2 * picture.methods)) {
    const int pixel = int(seen[k]), x = pixel % width / k_side, y = pixel / width / k_side;
    const int block = y * picture.across + x;
    if (x >= picture.across || block >= picture.blocks) continue;
    const float* row = seen.data() + k;
    for (const int end : {0, 1}) {
      const double share = end == 1 ? double(row[4]) : 1 - double(row[4]), past = double(row[5 + end]);
      add_vertex(picture.parts[std::size_t(block)], terms, row, double(row[k_seen + 2 * picture.method + end]),
                 unit * share * past);
    }
  }
}

Case read_case(const std::string& folder, int method, double direction_spread) {
  const auto about = read<double>(folder + "/about.f64");
  const Terms terms{read<double>(folder + "/terms.f64"), direction_spread};
  if (about.size() != 7) {
    fmt::print(stderr, "{}: about.f64 holds {} numbers, not 7: made by another samples.cpp\n", folder, about.size());
    std::exit(3);
  }
  const int width = int(about[0]), height = int(about[1]);
  Case picture;
  picture.name = folder.substr(folder.find_last_of('/') + 1);
  picture.groom = picture.name.substr(picture.name.find_last_of('_') + 1);
  picture.method = method;
  picture.methods = int(about[5]);
  picture.across = width / k_side;
  picture.blocks = picture.across * (height / k_side);
  picture.thickness = about[4];
  picture.within = about[6] > 0 ? Within::hair_on_head : Within::hair_alone;
  const auto blocks = std::size_t(picture.blocks);
  for (auto* sums : {&picture.direct, &picture.multiple, &picture.variance}) sums->assign(blocks, glm::dvec3(0));
  picture.parts.assign(blocks, {});
  for (int c = 0; c < 3; ++c)
    picture.albedo[c] =
        terms.numbers[std::size_t(k_rows / 2 * 27 + c)] + terms.numbers[std::size_t(k_rows / 2 * 27 + 9 + c)];
  add_light(picture, read<float>(folder + "/light.f32"), width);
  add_parts(picture, terms, read<float>(folder + "/seen.f32"), width, about[3] / (k_side * k_side * about[2]));
  double brightest = 0;
  const auto sum = [&](std::size_t b) { return glm::dot(picture.direct[b] + picture.multiple[b], glm::dvec3(1)); };
  for (std::size_t b = 0; b < blocks; ++b) brightest = std::max(brightest, sum(b));
  for (std::size_t b = 0; b < blocks; ++b) picture.lit.push_back(sum(b) > 0.05 * brightest);
  return picture;
}

/// What a block's light is by the table's numbers.
lut::PositiveEquation equation_of(const Case& picture, std::size_t block, int c) {
  const Between a = between_albedos(picture.albedo[c]), t = between_thicknesses(picture.thickness);
  lut::PositiveEquation equation{.terms = {}, .value = picture.multiple[block][c], .weight = 1};
  for (int f = 0; f < k_factors; ++f)
    for (int d = 0; d < k_depths; ++d)
      for (int angle = 0; angle < k_angles; ++angle) {
        const double part = picture.parts[block][place_of_part(f, d, angle)][c];
        for (int corner = 0; corner < 8; ++corner) {
          const int dt = corner / 4, da = corner / 2 % 2, other = corner % 2;
          const double factor =
              part * (dt ? t.share : 1 - t.share) * (da ? a.share : 1 - a.share) * (other ? a.share : 1 - a.share);
          if (factor != 0)
            equation.terms.push_back({std::uint32_t(place_of(f, t.below + dt, a.below + da, d)), factor,
                                      std::uint32_t(place_of_angle(f, a.below + other, angle))});
        }
      }
  return equation;
}

/// Every lit block beside the root mean square of its picture, and each picture's mean.
void append_equations(const Case& picture, double weight_of_mean, std::vector<lut::PositiveEquation>& equations) {
  for (int c = 0; c < 3; ++c) {
    double squares = 0, lit = 0, all = 0;
    for (std::size_t b = 0; b < picture.lit.size(); ++b) {
      const double light = picture.direct[b][c] + picture.multiple[b][c];
      all += light;
      if (picture.lit[b]) squares += light * light, lit += 1;
    }
    const double share = 1 / std::sqrt(picture.methods);
    lut::PositiveEquation mean{.terms = {}, .value = 0, .weight = share * weight_of_mean / all};
    for (std::size_t b = 0; b < picture.lit.size(); ++b) {
      lut::PositiveEquation equation = equation_of(picture, b, c);
      mean.value += equation.value;
      mean.terms.insert(mean.terms.end(), equation.terms.begin(), equation.terms.end());
      equation.weight = share / std::sqrt(squares);
      if (picture.lit[b]) equations.push_back(std::move(equation));
    }
    equations.push_back(std::move(mean));
  }
}

struct Errors {
  glm::dvec3 light{0};  ///< of the reference's
  double rms = 0, noise = 0;
};

/// Direct light by paths, and the rest by the numbers.
Errors errors_of(const Case& picture, std::span<const double> numbers) {
  glm::dvec3 drawn(0), wanted(0), squares(0), off(0), noise(0);
  for (std::size_t b = 0; b < picture.lit.size(); ++b) {
    glm::dvec3 multiple(0);
    for (int c = 0; c < 3; ++c)
      for (const auto& [place, factor, other] : equation_of(picture, b, c).terms)
        multiple[c] += factor * numbers[place] * numbers[other];
    const glm::dvec3 right = picture.direct[b] + picture.multiple[b], difference = multiple - picture.multiple[b];
    drawn += picture.direct[b] + multiple;
    wanted += right;
    if (!picture.lit[b]) continue;
    squares += right * right;
    off += difference * difference;
    noise += picture.variance[b];
  }
  const double all = squares.x + squares.y + squares.z;
  return {drawn / wanted, std::sqrt((off.x + off.y + off.z) / all), std::sqrt((noise.x + noise.y + noise.z) / all)};
}

/// Sums over pictures of one method: how far channels are off, and squares without noise; before and after.
struct Sums {
  glm::dvec2 apart{0}, squares{0};
  double pictures = 0;
  void add(const Errors& was, const Errors& is) {
    for (int c = 0; c < 3; ++c) apart += glm::abs(glm::dvec2(is.light[c], was.light[c]) - 1.0) / 3.0;
    squares += glm::dvec2(is.rms * is.rms, was.rms * was.rms) - is.noise * is.noise;
    pictures += 1;
  }
  void print(const std::string& title) const {
    fmt::print("{} of {}: a channel's mean off by {:.3f} (was {:.3f}), rms without noise {:.3f} (was {:.3f})\n", title,
               pictures, apart.x / pictures, apart.y / pictures, std::sqrt(squares.x / pictures),
               std::sqrt(squares.y / pictures));
  }
};

/// Prints sums of each method; of each picture by the scene's own method too, where `each` is set.
void report(const std::string& title, const std::vector<Case>& cases, std::span<const double> before,
            std::span<const double> after, bool each) {
  std::map<int, Sums> sums;
  for (const Case& picture : cases) {
    const Errors was = errors_of(picture, before), is = errors_of(picture, after);
    sums[picture.method].add(was, is);
    if (each)
      fmt::print(
          "{} {} method {} thickness {:5.2f}  light {:.3f} {:.3f} {:.3f} (was {:.3f} {:.3f} {:.3f})  rms {:.3f} (was "
          "{:.3f}, noise {:.3f})\n",
          title, picture.name, picture.method, picture.thickness, is.light.x, is.light.y, is.light.z, was.light.x,
          was.light.y, was.light.z, is.rms, was.rms, is.noise);
  }
  for (const auto& [method, of_method] : sums) of_method.print(fmt::format("{}, method {},", title, method));
}

lut::PositiveFit fit_to(const std::vector<Case>& told, const Weights& weights) {
  std::vector<lut::PositiveEquation> equations;
  for (const Case& picture : told) append_equations(picture, weights.mean, equations);
  const std::array<lut::PositiveShape, 2> shapes{
      {{k_factors, {k_thicknesses, k_albedos, k_depths}, 2}, {k_factors, {1, k_albedos, k_angles}, k_factors}}};
  auto fit = lut::fit_positive(equations, shapes, {weights.bend, weights.slope, weights.pull});
  if (!fit) {
    fmt::print(stderr, "{}\n", fit.error().message);
    std::exit(5);
  }
  return std::move(fit).value();
}

/// Each groom by a table that was fitted to all others.
void report_left_out(const std::vector<Case>& cases, std::span<const double> before, const Weights& weights) {
  std::set<std::string> grooms;
  for (const Case& picture : cases) grooms.insert(picture.groom);
  std::map<int, Sums> sums;
  for (const std::string& groom : grooms) {
    std::vector<Case> others;
    for (const Case& picture : cases)
      if (picture.groom != groom) others.push_back(picture);
    const lut::PositiveFit fit = fit_to(others, weights);
    for (const Case& picture : cases)
      if (picture.groom == groom) sums[picture.method].add(errors_of(picture, before), errors_of(picture, fit.numbers));
  }
  for (const auto& [method, of_method] : sums) of_method.print(fmt::format("left out, method {},", method));
}

void print_table(fmt::ostream& file, std::string_view name, const std::vector<double>& numbers) {
  file.print("constexpr double {}[k_numbers] = {{\n", name);
  for (std::size_t k = 0; k < numbers.size(); ++k)
    file.print("{}{:.3g},{}", k % 8 ? " " : "      ", numbers[k], (k + 1) % 8 && k + 1 < numbers.size() ? "" : "\n");
  file.print("}};\n");
}

void write_tables(const std::string& path, const std::vector<double>& alone, const std::vector<double>& on_head) {
  auto file = fmt::output_file(path);
  file.print("#include \"bsdf/dual_scattering/corrections.h\"\n\nnamespace cuticle::bsdf::dual_scattering {{\n\n");
  file.print(
      "// Written by bench/multiple_scattering/fit.cpp; bench/results/multiple_scattering.txt says from what.\n");
  file.print("namespace {{\n\n");
  print_table(file, "k_hair_alone", alone);
  print_table(file, "k_hair_on_head", on_head);
  file.print(
      "\n}}  // namespace\n\nstd::span<const double, k_numbers> fitted_corrections(Within within) {{\n"
      "  return within == Within::hair_alone ? k_hair_alone : k_hair_on_head;\n}}\n\n");
  file.print("}}  // namespace cuticle::bsdf::dual_scattering\n");
}

std::vector<Case> cases_within(const std::vector<Case>& cases, Within within) {
  std::vector<Case> chosen;
  std::ranges::copy_if(cases, std::back_inserter(chosen), [&](const Case& one) { return one.within == within; });
  return chosen;
}

/// What of a fit is asked for.
struct Wish {
  bool leave_out = false, judge = false;
};

std::vector<double> fitted_within(Within within, const std::vector<Case>& all_told, const std::vector<Case>& all_held,
                                  const Weights& weights, const Wish& wish) {
  const std::vector<Case> told = cases_within(all_told, within), held = cases_within(all_held, within);
  std::vector<double> before(k_numbers, 1.0);
  std::fill_n(before.begin() + place_of(2, 0, 0, 0), k_depth_numbers / k_factors, 0.0);
  const auto compiled = fitted_corrections(within);
  std::vector<double> numbers(compiled.begin(), compiled.end());
  const std::string where = within == Within::hair_alone ? " hair alone" : " on a head";
  if (!wish.judge && !told.empty()) {
    const lut::PositiveFit fit = fit_to(told, weights);
    fmt::print("{}: {} steps, cost {:.4f} from {:.4f}\n", where, fit.steps, fit.cost_after, fit.cost_before);
    numbers = fit.numbers;
  }
  report((wish.judge ? "told" : "fitted") + where, told, before, numbers, !wish.leave_out);
  report("held" + where, held, before, numbers, !wish.leave_out);
  if (wish.leave_out) report_left_out(told, before, weights);
  return numbers;
}

}  // namespace

int main(int count, char** given) {
  std::vector<Case> told, held;
  Weights weights;
  Wish wish;
  bool is_held = false;
  double direction_spread = Terms{}.direction_spread;
  const std::map<std::string, double*> numbers{{"--bend", &weights.bend},
                                               {"--slope", &weights.slope},
                                               {"--pull", &weights.pull},
                                               {"--mean", &weights.mean},
                                               {"--direction-spread", &direction_spread}};
  for (int k = 2; k < count; ++k) {
    const std::string word = given[k];
    if (word == "--held") {
      is_held = true;
    } else if (word == "--leave-out") {
      wish.leave_out = true;
    } else if (word == "--judge") {
      wish.judge = true;
    } else if (const auto number = numbers.find(word); number != numbers.end() && k + 1 < count) {
      *number->second = std::atof(given[++k]);
    } else {
      auto& cases = is_held ? held : told;
      for (int method = 0, methods = 1; method < methods; ++method) {
        cases.push_back(read_case(word, method, direction_spread));
        methods = cases.back().methods;
      }
    }
  }
  if (told.empty()) {
    fmt::print(stderr,
               "fit_multiple_scattering TABLE.cpp [--bend B] [--slope S] [--pull P] [--mean M] [--direction-spread R] "
               "[--leave-out] [--judge] FOLDER ... [--held FOLDER ...]\n");
    return 2;
  }
  const auto alone = fitted_within(Within::hair_alone, told, held, weights, wish),
             on_head = fitted_within(Within::hair_on_head, told, held, weights, wish);
  if (!wish.judge) write_tables(given[1], alone, on_head);
}
