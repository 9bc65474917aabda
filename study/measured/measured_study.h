#pragma once
// Every fibre model beside a real fibre's measurement: fitted on one half of its directions, judged on the other.
#include <string>
#include <vector>

#include "bsdf/fibre.h"
#include "bsdf/measured/measured.h"
#include "core/progress.h"
#include "study/engine/study.h"

namespace cuticle::study {

struct MeasuredRequest {
  std::string file = {}, format = {};  ///< empty file: a synthetic one, by walks through a rough fibre
  bsdf::Gantry gantry = {};
  std::string hair = "blond";       ///< of the synthetic file
  std::int64_t walks = 4000000;     ///< of the synthetic file
  std::vector<std::string> models;  ///< empty: all that are registered
  std::string write = {};           ///< file that the synthetic measurement is written to; empty: none
};

/// Light that is walked through the fibre (study/oracle), at the directions of a gantry: theta 41 .. 79 in steps of 2
/// degrees, phi 72 .. 288 in steps of 4; a value is the mean of S over that cell. As a text in the shared format.
std::string synthetic_measurement(const bsdf::Fibre& fibre, const bsdf::Gantry& gantry, std::int64_t walks);

/// A group with a point for each model, the cuts with the measurement as one more curve, the fits, and the features.
/// Errors: the reader's, with file and line; usage for an unknown model or hair.
Result<Study> measured_study(const MeasuredRequest& request, Progress& progress);

/// Features of real fibres as published, and what models and walks make of them.
struct Feature {
  std::string what, source, published;  ///< "-" in `published`: a prediction without a number to hold it to
  double low = 0, high = 0;             ///< what a prediction may be, in degrees; low > high: nothing is asked
  struct Prediction {
    std::string by;
    double degrees = 0;
  };
  std::vector<Prediction> predictions = {};
};
Result<std::vector<Feature>> published_features(std::int64_t walks);
/// The features as a table of the page.
Table feature_table(const std::vector<Feature>& features);

}  // namespace cuticle::study
