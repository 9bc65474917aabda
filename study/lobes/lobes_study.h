#pragma once
// What the accuracy of every fibre model costs in time, and how its lobes look on one physical fibre.
#include <span>
#include <string>
#include <vector>

#include "bsdf/model.h"
#include "core/progress.h"

namespace cuticle::study {

struct LobesRequest {
  bsdf::Fibre fibre;                ///< mapped onto each model by its own `from_fibre`
  std::string fibre_name;           ///< for the page
  std::vector<std::string> models;  ///< empty: all that are registered
  std::size_t points = 4096;        ///< random directions that errors are taken over, at most
  double reference_seconds = 20;    ///< one thread's time for a reference; where it takes more, fewer points
  double seconds = 0.3;             ///< for the timings of a row together, of which the best counts
  std::size_t samples = 361;        ///< of each curve
};

/// A tier of a model: settings in a precision. The reference of a model is its last study case in double (its fibre's
/// settings where it has no study cases); errors are relative to it where it is above 1e-6 of its largest value.
struct TierRow {
  std::string model, tier, precision, settings;
  bool reference = false;
  std::size_t points = 0;  ///< that the errors are over
  double ns = 0;           ///< per evaluation of S, rgb, one thread
  double median_error = 0, p99_error = 0, max_error = 0;
};

/// One line of a plot, and a plot; a polar plot has angles in degrees as x.
struct Curve {
  std::string name;
  std::vector<double> x, y;
};
struct Plot {
  std::string name, title, x_label, y_label;
  bool polar = false;
  std::vector<Curve> curves;
};

/// A place that the literature names, where the model has it: in degrees.
struct Landmark {
  std::string model, what;
  double expected = 0, measured = 0;
};
struct Landmarks {
  std::vector<Landmark> places;
  std::vector<Plot> plots;
};

struct LobesStudy {
  std::string fibre_name;
  std::vector<TierRow> rows;
  std::vector<Plot> plots;
  std::vector<Landmark> landmarks;
  std::vector<std::string> notes;  ///< how the fibre was mapped onto each model
};

/// Times and compares the tiers, and samples the curves. Errors: usage for an unknown model; what evaluation says.
Result<LobesStudy> run_lobes_study(const LobesRequest& request, Progress& progress);

/// The parts of run_lobes_study for one model whose parameters are `settings`.
Result<std::vector<TierRow>> compare_tiers(const bsdf::Model& model, const std::string& settings,
                                           const LobesRequest& request);
/// The settings with those of the model's last study case over them: the reference's.
std::string finest_settings(const bsdf::Model& model, const std::string& settings);
Result<std::vector<Plot>> lobe_plots(const bsdf::Model& model, const std::string& settings, std::size_t samples);
/// Albedo against theta_o, as one curve.
Result<Curve> albedo_curve(const bsdf::Model& model, const std::string& settings, std::size_t samples);
/// Peaks of M at normal incidence with beta = 0.02, and the caustic of TRT for an index of 1.55, of a model called
/// marschner; and the curves that they are places of.
Result<Landmarks> landmarks_of(const bsdf::Model& model, const std::string& settings, std::size_t samples);

std::string to_json(const LobesStudy& study);
std::string to_csv(const LobesStudy& study);
/// Writes study.json and study.csv (study/README.md) into a folder, which is made.
Result<void> write_lobes_study(const LobesStudy& study, const std::string& folder);

}  // namespace cuticle::study
