// Errors of the rungs, their sum, and the ladder as a group of the study.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/common.hpp>

#include "study/picture/picture_study.h"
#include "study/picture/shown_picture.h"

namespace cuticle::study {
namespace {

std::vector<const NoisyPicture*> pictures_of(const Ladder& ladder) {
  std::vector<const NoisyPicture*> pictures;
  for (const RungPicture& rung : ladder.rungs) pictures.push_back(&rung.picture);
  return pictures;
}

/// Display values of |picture - truth|, as bright as the pictures.
Image error_picture(const Image& picture, const Image& truth, double exposure) {
  Image error = truth;
  for (std::size_t k = 0; k < error.pixels.size(); ++k)
    error.pixels[k] = k % 4 == 3 ? 1.0f : std::abs(picture.pixels[k] - truth.pixels[k]);
  return tone_map(error, exposure);
}

std::string shown(double value) { return fmt::format("{:.4g}", value); }

/// Of each colour the light over the truth's, with what the noise of both leaves open.
std::vector<std::string> shown_light(const NoisyPicture& picture, const NoisyPicture& truth) {
  std::vector<std::string> words;
  for (const LightShare& share : light_shares(picture, truth))
    words.push_back(share.half_width > 0 ? fmt::format("{:.3f} +- {:.3f}", share.share, share.half_width)
                                         : fmt::format("{:.3f}", share.share));
  return words;
}

/// The means of every second batch: half of the paths.
NoisyPicture half_of(const NoisyPicture& picture, std::size_t first) {
  NoisyPicture half;
  for (std::size_t k = first; k < picture.batches.size(); k += 2) half.batches.push_back(picture.batches[k]);
  return {{mean_of(half)}};
}

Table ladder_table(const std::string& name, const Ladder& ladder, const LadderSum& sum) {
  Table table{
      fmt::format("ladder_{}", name),
      fmt::format("{}: what each rung adds to the relative MSE of the picture", name),
      {"rung", "what it does", "added, relative MSE", "against the truth", "red light / truth", "green", "blue"},
      {}};
  const NoisyPicture& truth = ladder.rungs.front().picture;
  for (std::size_t k = 0; k < ladder.rungs.size(); ++k) {
    const std::vector<std::string> light = shown_light(ladder.rungs[k].picture, truth);
    table.rows.push_back({ladder.rungs[k].rung.name, ladder.rungs[k].rung.words, k == 0 ? "0" : shown(sum.added[k - 1]),
                          k == 0 ? "0" : shown(sum.against_truth[k - 1]), light[0], light[1], light[2]});
  }
  table.rows.push_back({"sum of what they add", "", shown(sum.sum), ""});
  table.rows.push_back({"total", "the last picture against the first", "", shown(sum.total)});
  table.rows.push_back({"remainder",
                        fmt::format("total less sum; twice the products of the steps: {}", shown(sum.products)),
                        shown(sum.remainder), ""});
  table.rows.push_back(
      {"noise", "path tracing with other seeds against itself: left out of all numbers above", shown(sum.noise), ""});
  for (auto& row : table.rows) row.resize(table.columns.size());
  return table;
}

void add_pictures(Study& study, const std::string& name, const Ladder& ladder) {
  const Image truth = shown_picture(ladder.rungs.front().picture);
  const double exposure = ladder.rungs.front().scene.outputs.exposure_stops;
  const std::string first = name + "_00_path_tracing.png";
  study.pictures.push_back({fmt::format("{}_noise.png", name),
                            fmt::format("{}: path tracing by half of its paths", name), first,
                            tone_map(shown_picture(half_of(ladder.rungs.front().picture, 0)), exposure)});
  for (std::size_t k = 0; k < ladder.rungs.size(); ++k) {
    const RungPicture& rung = ladder.rungs[k];
    const Image color = shown_picture(rung.picture);
    const std::string stem = fmt::format("{}_{:02}_{}", name, k, rung.rung.name);
    study.pictures.push_back(
        {stem + ".png", fmt::format("{}: {}", name, rung.rung.name), k == 0 ? "" : first, tone_map(color, exposure)});
    if (k > 0)
      study.pictures.push_back({stem + "_error.png",
                                fmt::format("{}: {}, |difference| from path tracing", name, rung.rung.name), "",
                                error_picture(color, truth, exposure)});
  }
}

/// One frame: the hair simulated, then drawn.
Work work_of(const RungPicture& rung) {
  if (!rung.runner) return {};
  return {{},
          [runner = rung.runner, pose = rung.pose]() -> Result<void> {
            CUTICLE_TRY(pose->simulate_further());
            CUTICLE_TRY(runner->run(0));
            return {};
          },
          1};
}

}  // namespace

LadderSum sum_of(const Ladder& ladder) {
  const RelativeSquares squares(pictures_of(ladder));
  const auto& rungs = ladder.rungs;
  const NoisyPicture &first = rungs.front().picture, &last = rungs.back().picture;
  LadderSum sum;
  for (std::size_t k = 1; k < rungs.size(); ++k) {
    const NoisyPicture &before = rungs[k - 1].picture, &after = rungs[k].picture;
    sum.added.push_back(squares.mean(before, after, before, after));
    sum.against_truth.push_back(squares.mean(first, after, first, after));
    sum.sum += sum.added.back();
    for (std::size_t j = 1; j < k; ++j)
      sum.products += 2 * squares.mean(rungs[j - 1].picture, rungs[j].picture, before, after);
  }
  sum.total = squares.mean(first, last, first, last);
  sum.remainder = sum.total - sum.sum;
  const NoisyPicture half = half_of(first, 0), other = half_of(first, 1);
  sum.noise = squares.mean(half, other, half, other) / 2;  // halves of the paths differ by twice as much
  return sum;
}

void add_ladder(Study& study, const std::string& name, const Ladder& ladder) {
  const LadderSum sum = sum_of(ladder);
  const RelativeSquares squares(pictures_of(ladder));
  const NoisyPicture& truth = ladder.rungs.front().picture;
  Group group{.name = name,
              .title = fmt::format("{}: from path tracing to the real-time picture", name),
              .truth = ladder.rungs.front().rung.words + " (path tracing)",
              .metrics = {{"picture", "relative MSE of the picture", "1", Mean::squares},
                          {"added", "relative MSE that the rung adds", "1", Mean::squares},
                          {"light", "relative MSE that the rung adds to the light of 8 x 8 pixels", "1", Mean::squares},
                          {"strand", "rms relative error of a strand's radiance", "1", Mean::root_of_squares}},
              .item = "tile of 8 x 8 pixels"};
  for (std::size_t k = 0; k < ladder.rungs.size(); ++k) {
    const RungPicture &rung = ladder.rungs[k], &before = ladder.rungs[k == 0 ? 0 : k - 1];
    Measured measured{
        {squares.tiles(truth, rung.picture), squares.tiles(before.picture, rung.picture),
         squares.light(before.picture, rung.picture), strand_squares(rung.picture, truth, ladder.strands)},
        rung.bytes};
    group.points.push_back(
        {rung.rung.name, {}, [measured]() -> Result<Measured> { return measured; }, work_of(rung), rung.seconds});
  }
  study.groups.push_back(std::move(group));
  study.tables.push_back(ladder_table(name, ladder, sum));
  add_pictures(study, name, ladder);
}

}  // namespace cuticle::study
