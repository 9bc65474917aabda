#pragma once
// The checks, one file each, and what they share.
#include <numbers>

#include "study/model_check/model_check.h"

namespace cuticle::study::model_check {

constexpr double degree = std::numbers::pi / 180;

Verdict white_furnace(const Subject&, const Options&);
Verdict absorbing_furnace(const Subject&, const Options&);
Verdict reciprocity(const Subject&, const Options&);
Verdict pdf_normalised(const Subject&, const Options&);
Verdict chi_square(const Subject&, const Options&);
Verdict sample_weights(const Subject&, const Options&);
Verdict lobe_tails(const Subject&, const Options&);
Verdict caustic_continuity(const Subject&, const Options&);
Verdict finite(const Subject&, const Options&);

/// The views of a furnace, up to 89.9 degrees from both sides, at several offsets in the near field.
std::vector<bsdf::Point> furnace_views(const Subject& subject, const Options& options);
/// A few views for checks that draw many samples.
std::vector<bsdf::Point> sampling_views(const Subject& subject, const Options& options);
/// Of the energy of a view: where the model itself says that its error is larger, a furnace learns nothing.
constexpr double most_own_error = 0.25;
/// "theta_o = 89.9 deg, h = 0.5 (white, narrow)".
std::string where(const Subject& subject, const Scatterer& scatterer, const bsdf::Point& view);
/// The subject in each of the situations that it can be put into.
std::vector<Scatterer> scatterers(const Subject& subject, std::span<const Situation> situations);
/// A verdict that nothing could be checked, and why.
Verdict skipped(std::string why);
/// Passed where measured <= allowed.
Verdict judged(double measured, double allowed, std::string words);

/// The mean of the channels.
double brightness(const glm::dvec3& rgb);
/// The largest magnitude of the channels.
double largest(const glm::dvec3& rgb);
/// One value of a batch function.
glm::dvec3 value_at(const Batch& batch, const bsdf::Point& point);
std::vector<glm::dvec3> values_at(const Batch& batch, std::span<const bsdf::Point> points);
/// Whether S is itself a quadrature there, one that reports an error.
bool averages(const Scatterer& scatterer, const bsdf::Point& view);
/// Samples for one view by a seeded stream.
std::vector<bsdf::Sample> draw(const Scatterer& scatterer, const bsdf::Point& view, std::size_t count,
                               std::uint64_t seed);
/// The point of S and pdf that a sample of a view stands for.
bsdf::Point point_of(const bsdf::Sample& sample, const bsdf::Point& view);

/// The worst value so far and where it was.
struct Worst {
  double value = 0;
  std::string where;
  void note(double candidate, const std::string& place);
};

}  // namespace cuticle::study::model_check
