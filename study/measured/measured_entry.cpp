#include <charconv>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "study/engine/split.h"
#include "study/measured/measured_study.h"
#include "study/registry/entries.h"

namespace cuticle::study {
namespace {

Result<double> inclination(const std::string& text) {
  double degrees = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), degrees);
  if (code == std::errc() && end == text.data() + text.size() && std::abs(degrees) < 90)
    return degrees * std::numbers::pi / 180;
  return usage_error(fmt::format("--theta-o: '{}' is no angle inside -90 .. 90 degrees", text));
}

Result<Study> declare_measured(const StudyRequest& request, Progress& progress) {
  MeasuredRequest measured;
  measured.file = request.options.at("file");
  measured.format = request.options.at("format");
  measured.hair = request.options.at("hair");
  measured.write = request.options.at("write");
  CUTICLE_ASSIGN(measured.gantry.theta_o, inclination(request.options.at("theta-o")));
  if (request.options.at("models") != "all") measured.models = split_commas(request.options.at("models"));
  if (!request.quick) return measured_study(measured, progress);
  measured.walks = 400000;
  if (measured.models.empty())
    measured.models = {"hairworks", "kajiya_kay", "karis", "marschner", "scheuermann"};
  return measured_study(measured, progress);
}

}  // namespace

const StudyEntry& measured_entry() {
  static const StudyEntry entry{
      .name = "measured",
      .summary = "fibre models fitted to half of a measured fibre's directions, judged on the other half",
      .options = {{"file", "", "goniometer text, CSV or table of slices; none: a synthetic measurement", true},
                  {"format", "", "gantry, csv or slices; none: by the file's name"},
                  {"theta-o", "-30", "inclination of the gantry's arm that stands still, degrees"},
                  {"models", "all",
                   "models, a,b,c, or all (quick: without chiang, deon, huang and yan_fur, which integrate)"},
                  {"hair", "blond", "fibre of the synthetic measurement"},
                  {"write", "", "file that the synthetic measurement is written to"}},
      .declare = declare_measured,
      .quick_seconds = 10,
      .seconds = 400};
  return entry;
}

}  // namespace cuticle::study
