// Errors of the rungs, their sum, and the ladder as a group of the study.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/core.h>

#include "study/picture/picture_study.h"

namespace cuticle::study {
namespace {

double luminance(const float* pixel) {
  return 0.2126 * double(pixel[0]) + 0.7152 * double(pixel[1]) + 0.0722 * double(pixel[2]);
}

bool is_covered(const Image& image, std::size_t pixel) { return image.pixels[4 * pixel + 3] > 0; }

/// Squared mean of the truth where it covers.
double offset_of(const Image& truth) {
  double sum = 0, count = 0;
  for (std::size_t p = 0; p < truth.pixels.size() / 4; ++p)
    if (is_covered(truth, p)) {
      sum += luminance(&truth.pixels[4 * p]);
      ++count;
    }
  const double mean = count > 0 ? sum / count : 1;
  return std::max(mean * mean, 1e-12);
}

using Pictures = std::vector<const Image*>;

Pictures pictures_of(const Ladder& ladder) {
  Pictures pictures;
  for (const RungPicture& rung : ladder.rungs) pictures.push_back(&rung.color);
  return pictures;
}

/// Pixels that any of them covers, so that all squared errors are means over the same ones.
std::vector<bool> covered_by_any(const Pictures& pictures) {
  std::vector<bool> covered(pictures.front()->pixels.size() / 4, false);
  for (const Image* picture : pictures)
    for (std::size_t p = 0; p < covered.size(); ++p) covered[p] = covered[p] || is_covered(*picture, p);
  return covered;
}

/// Weighted product of two steps (b - a) and (d - c), mean over the pixels: of a step with itself its squared error.
class Products {
 public:
  /// The first of the pictures is the truth.
  explicit Products(const Pictures& pictures)
      : truth_(*pictures.front()), covered_(covered_by_any(pictures)), offset_(offset_of(truth_)) {
    count_ = double(std::max<std::ptrdiff_t>(1, std::ranges::count(covered_, true)));
  }
  double of(const Image& a, const Image& b, const Image& c, const Image& d) const {
    double sum = 0;
    for (std::size_t p = 0; p < covered_.size(); ++p) sum += covered_[p] ? pixel(p, a, b, c, d) : 0;
    return sum / count_;
  }
  std::vector<double> squares(const Image& a, const Image& b) const {
    std::vector<double> errors;
    for (std::size_t p = 0; p < covered_.size(); ++p)
      if (covered_[p]) errors.push_back(pixel(p, a, b, a, b));
    return errors;
  }

 private:
  double pixel(std::size_t p, const Image& a, const Image& b, const Image& c, const Image& d) const {
    double sum = 0;
    for (std::size_t k = 4 * p; k < 4 * p + 3; ++k) {
      const double truth = double(truth_.pixels[k]);
      sum += (double(b.pixels[k]) - double(a.pixels[k])) * (double(d.pixels[k]) - double(c.pixels[k])) / (truth * truth + offset_) / 3;
    }
    return sum;
  }
  const Image& truth_;
  std::vector<bool> covered_;
  double offset_, count_;
};

/// Display values of |picture - truth|, as bright as the pictures.
Image error_picture(const Image& picture, const Image& truth, double exposure) {
  Image error = truth;
  for (std::size_t k = 0; k < error.pixels.size(); ++k)
    error.pixels[k] = k % 4 == 3 ? 1.0f : std::abs(picture.pixels[k] - truth.pixels[k]);
  return tone_map(error, exposure);
}

std::string shown(double value) { return fmt::format("{:.4g}", value); }

Table ladder_table(const std::string& name, const Ladder& ladder, const LadderSum& sum) {
  Table table{fmt::format("ladder_{}", name), fmt::format("{}: what each rung adds to the relative MSE of the picture", name),
              {"rung", "what it does", "added, relative MSE", "against the truth"}, {}};
  for (std::size_t k = 0; k < ladder.rungs.size(); ++k)
    table.rows.push_back({ladder.rungs[k].rung.name, ladder.rungs[k].rung.words, k == 0 ? "0" : shown(sum.added[k - 1]),
                          k == 0 ? "0" : shown(sum.against_truth[k - 1])});
  table.rows.push_back({"sum of what they add", "", shown(sum.sum), ""});
  table.rows.push_back({"total", "the last picture against the first", "", shown(sum.total)});
  table.rows.push_back({"remainder", fmt::format("total less sum; twice the products of the steps: {}", shown(sum.products)), shown(sum.remainder), ""});
  table.rows.push_back({"noise", "path tracing with another seed against itself", shown(sum.noise), ""});
  return table;
}

void add_pictures(Study& study, const std::string& name, const Ladder& ladder) {
  const Image& truth = ladder.rungs.front().color;
  const double exposure = ladder.rungs.front().scene.outputs.exposure_stops;
  const std::string first = name + "_00_path_tracing.png";
  study.pictures.push_back({fmt::format("{}_noise.png", name), fmt::format("{}: path tracing with another seed", name), first, tone_map(ladder.again, exposure)});
  for (std::size_t k = 0; k < ladder.rungs.size(); ++k) {
    const RungPicture& rung = ladder.rungs[k];
    const std::string stem = fmt::format("{}_{:02}_{}", name, k, rung.rung.name);
    study.pictures.push_back({stem + ".png", fmt::format("{}: {}", name, rung.rung.name), k == 0 ? "" : first, tone_map(rung.color, exposure)});
    if (k > 0)
      study.pictures.push_back({stem + "_error.png", fmt::format("{}: {}, |difference| from path tracing", name, rung.rung.name), "", error_picture(rung.color, truth, exposure)});
  }
}

Work work_of(const RungPicture& rung) {
  if (!rung.runner) return {};
  return {{}, [runner = rung.runner]() -> Result<void> {
            CUTICLE_ASSIGN(const plan::FrameResult frame, runner->run(0));
            return {};
          }, 1};
}

}  // namespace

std::vector<double> squared_errors(const Image& a, const Image& b, const Image& truth) {
  return Products({&truth, &a, &b}).squares(a, b);
}

std::vector<double> strand_errors(const Image& picture, const Image& truth, const std::vector<int>& strands) {
  struct Sums {
    double picture = 0, truth = 0, count = 0;
  };
  std::map<int, Sums> sums;
  double mean = 0, pixels = 0;
  for (std::size_t p = 0; p < strands.size(); ++p) {
    if (strands[p] < 0) continue;
    Sums& of = sums[strands[p]];
    of.picture += luminance(&picture.pixels[4 * p]);
    of.truth += luminance(&truth.pixels[4 * p]);
    ++of.count;
    mean += luminance(&truth.pixels[4 * p]);
    ++pixels;
  }
  std::vector<double> errors;
  for (const auto& [strand, of] : sums)
    if (of.count >= 4) errors.push_back((of.picture - of.truth) / of.count / std::max(mean / std::max(pixels, 1.0), 1e-12));
  return errors;
}

LadderSum sum_of(const Ladder& ladder) {
  const Products products(pictures_of(ladder));
  const auto& rungs = ladder.rungs;
  const Image &first = rungs.front().color, &last = rungs.back().color;
  LadderSum sum;
  for (std::size_t k = 1; k < rungs.size(); ++k) {
    sum.added.push_back(products.of(rungs[k - 1].color, rungs[k].color, rungs[k - 1].color, rungs[k].color));
    sum.against_truth.push_back(products.of(first, rungs[k].color, first, rungs[k].color));
    sum.sum += sum.added.back();
    for (std::size_t j = 1; j < k; ++j)
      sum.products += 2 * products.of(rungs[j - 1].color, rungs[j].color, rungs[k - 1].color, rungs[k].color);
  }
  sum.total = products.of(first, last, first, last);
  sum.remainder = sum.total - sum.sum;
  sum.noise = products.of(first, ladder.again, first, ladder.again);
  return sum;
}

void add_ladder(Study& study, const std::string& name, const Ladder& ladder) {
  const LadderSum sum = sum_of(ladder);
  const Image& truth = ladder.rungs.front().color;
  const Products products(pictures_of(ladder));
  Group group{.name = name,
              .title = fmt::format("{}: from path tracing to the real-time picture", name),
              .truth = ladder.rungs.front().rung.words + " (path tracing)",
              .metrics = {{"picture", "relative MSE of the picture"}, {"added", "relative MSE that the rung adds"}, {"strand", "relative error of a strand's radiance"}},
              .item = "pixel",
              .floor = sum.noise};
  for (std::size_t k = 1; k < ladder.rungs.size(); ++k) {
    const RungPicture& rung = ladder.rungs[k];
    Measured measured{{products.squares(truth, rung.color), products.squares(ladder.rungs[k - 1].color, rung.color),
                       strand_errors(rung.color, truth, ladder.strands)},
                      rung.bytes};
    group.points.push_back({rung.rung.name, {}, [measured]() -> Result<Measured> { return measured; }, work_of(rung), rung.seconds});
  }
  study.groups.push_back(std::move(group));
  study.tables.push_back(ladder_table(name, ladder, sum));
  add_pictures(study, name, ladder);
}

}  // namespace cuticle::study
