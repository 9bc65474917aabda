#pragma once
// What the accuracy of every fibre model costs in time, and how its lobes look on one physical fibre.
#include <span>
#include <string>
#include <vector>

#include "bsdf/model.h"
#include "core/progress.h"
#include "study/engine/study.h"
#include "study/oracle/rough_fibre.h"

namespace cuticle::study {

struct LobesRequest {
  bsdf::Fibre fibre;                ///< mapped onto each model by its own `from_fibre`
  std::string fibre_name;           ///< for the page
  std::vector<std::string> models;  ///< empty: all that are registered
  std::size_t points = 4096;        ///< random directions that errors are taken over; fewer where many paths are walked
  std::size_t samples = 361;        ///< of each curve
  std::int64_t walks = 1000000;     ///< of the Monte Carlo fibre, for each inclination of the viewer
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

/// A group for each model and field, the curves of its lobes, and the landmarks. Errors: usage for an unknown model;
/// what evaluation says.
Result<Study> lobes_study(const LobesRequest& request, Progress& progress);

/// The fibre in the model's parameters; one that has no mapping keeps its defaults, and the words say so.
bsdf::FibreMapping settings_of(const bsdf::Model& model, const bsdf::Fibre& fibre);
/// The registered study cases of a model, each over the settings; without any, the settings alone.
struct LobesTier {
  std::string name, settings;
};
std::vector<LobesTier> tiers_of(const bsdf::Model& model, const std::string& settings);

/// The fibre that light is walked through. A standard deviation of theta_i is that of twice the facets' slope, which for
/// Gaussian slopes is alpha / sqrt 2.
oracle::RoughFibre walked(const bsdf::Fibre& fibre);

/// One group for all models: S in float, far field, of every tier that is not too slow, against the Monte Carlo fibre
/// (study/oracle/rough_fibre.h); errors over bins of directions, and of the albedo. Error: what evaluation says.
Result<Group> across_models(std::span<const bsdf::Model* const> models, const LobesRequest& request);
/// Tiers of a model whose parameters are `settings`, in float and double. The near field is another function than the
/// far field: a group for each. Truth: the last of its tiers in double, at random directions.
Result<std::vector<Group>> tier_groups(const bsdf::Model& model, const std::string& settings,
                                       const LobesRequest& request);
/// The settings with those of the model's last study case over them: the reference's.
std::string finest_settings(const bsdf::Model& model, const std::string& settings);
/// The same, or `settings` where so many points by the reference would walk too many paths: those of the curves.
std::string shown_settings(const bsdf::Model& model, const std::string& settings, std::size_t points);
Result<std::vector<Plot>> lobe_plots(const bsdf::Model& model, const std::string& settings, std::size_t samples);
/// S of green light over phi and theta_i at theta_o = 20 degrees.
Result<Grid> lobe_grid(const bsdf::Model& model, const std::string& settings, std::size_t samples);
/// Albedo against theta_o, as one curve.
Result<Curve> albedo_curve(const bsdf::Model& model, const std::string& settings, std::size_t samples);
/// Peaks of M at normal incidence with beta = 0.02, and the caustic of TRT for an index of 1.55, of a model called
/// marschner; and the curves that they are places of.
Result<Landmarks> landmarks_of(const bsdf::Model& model, const std::string& settings, std::size_t samples);

}  // namespace cuticle::study
