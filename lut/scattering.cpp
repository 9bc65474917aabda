#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "lut/cell_average.h"
#include "lut/comparison.h"
#include "lut/scattering_reader.h"

namespace cuticle::lut {
namespace {

constexpr int k_directions = 16384;
constexpr int k_lights_of_viewer = 128;  ///< where a viewer's lights are cheap together

/// Light and eye evenly over the sphere, by an additive sequence in three dimensions (its ratio solves x^4 = x + 1),
/// with one eye for as many lights in a row.
std::vector<bsdf::Point> directions(int lights_of_viewer) {
  constexpr double ratio = 1.2207440846057596;
  std::vector<bsdf::Point> points(k_directions);
  for (int k = 0; k < k_directions; ++k) {
    const auto part = [](int number, double step) { return std::fmod(0.5 + (number + 1) * step, 1.0); };
    bsdf::Point& at = points[std::size_t(k)];
    at.theta_i = std::asin(2 * part(k, 1 / ratio) - 1);
    at.theta_o = std::asin(2 * part(k / lights_of_viewer, 1 / (ratio * ratio)) - 1);
    at.theta_d = std::abs(at.theta_o - at.theta_i) / 2;
    at.phi = part(k, 1 / (ratio * ratio * ratio)) * std::numbers::pi;
  }
  return points;
}
std::vector<bsdf::Point> directions(const Source& source) {
  return directions(source.measured_by ? k_lights_of_viewer : 1);
}

/// S of the model and of the two ways to put it together.
struct Scattering {
  std::vector<glm::dvec3> exact, assumed, stored;
};

/// Exact values of channels at the directions; those that differ in the colour only are evaluated once.
class ExactChannels {
 public:
  ExactChannels(const Source& source, std::span<const bsdf::Point> points) : source_(source), points_(points) {}
  Result<void> need(const TableLayout& table, const Channel& channel) {
    if (find(channel) != known_.end()) return {};
    std::vector<bsdf::Point> read;
    for (const bsdf::Point& at : points_) read.push_back(point_read(table, at));
    CUTICLE_ASSIGN(std::vector<glm::dvec3> values, channel_values(source_, channel, read));
    known_.emplace_back(&channel, std::move(values));
    return {};
  }
  double value(const Channel& channel, std::size_t i) const { return find(channel)->second[i][channel.component]; }

 private:
  using Known = std::vector<std::pair<const Channel*, std::vector<glm::dvec3>>>;
  Known::const_iterator find(const Channel& channel) const {
    return std::find_if(known_.begin(), known_.end(),
                        [&](const auto& each) { return same_lobes(*each.first, channel); });
  }
  const Source& source_;
  std::span<const bsdf::Point> points_;
  Known known_;
};

Result<std::vector<glm::dvec3>> assumed_scattering(const Source& source, const TableSet& set,
                                                   const ScatteringReader& reader,
                                                   std::span<const bsdf::Point> points) {
  ExactChannels exact(source, points);
  std::vector<glm::dvec3> result(points.size());
  for (int colour = 0; colour < 3; ++colour) {
    const std::vector<FactorPlace> places = places_of(set, colour);
    for (const FactorPlace& place : places)
      if (place.table) CUTICLE_TRY(exact.need(*place.table->layout, place.layout()));
    for (std::size_t i = 0; i < points.size(); ++i)
      result[i][colour] = composed(places, [&](const FactorPlace& place) { return exact.value(place.layout(), i); }) /
                          reader.divisor(points[i]);
  }
  return result;
}

/// Factors hold means over a texel's azimuths, so that peaks of no width have a number: S is averaged likewise.
class TexelMeans {
 public:
  explicit TexelMeans(const TableSet& set)
      : width_(set.layout->points_of_mean > 0 ? std::numbers::pi / (set.size - 1) : 0) {}
  /// S of the model: by adaptive quadrature, at as many azimuths as of the tables, or at the direction itself.
  Result<std::vector<glm::dvec3>> of_model(const Source& source, std::span<const bsdf::Point> points) const {
    if (source.measured_by) return of_many(source.measured_by, points);
    if (width_ == 0) {
      std::vector<glm::dvec3> values(points.size());
      CUTICLE_TRY(source.evaluate({bsdf::Quantity::S, -1, points}, values));
      return values;
    }
    // An interval's theta_d carries the direction's index; the lobe that is asked for stands for all.
    const Evaluate around = [&](const bsdf::Request& request, std::span<glm::dvec3> out) {
      std::vector<bsdf::Point> turned;
      for (const bsdf::Point& at : request.points) {
        turned.push_back(points[std::size_t(at.theta_d)]);
        turned.back().phi = at.phi;
      }
      return source.evaluate({bsdf::Quantity::S, -1, turned}, out);
    };
    std::vector<PhiInterval> intervals;
    for (std::size_t i = 0; i < points.size(); ++i)
      intervals.push_back({double(i), points[i].phi - width_ / 2, points[i].phi + width_ / 2});
    const Channel any{"S", bsdf::Quantity::S, source.model->lobes.front(), 0, Texel::cell_average};
    CUTICLE_ASSIGN(PhiAverages means, average_over_phi({source.model, around, around}, any, intervals));
    return std::move(means.values);
  }
  glm::dvec3 of_tables(const ScatteringReader& reader, const bsdf::Point& at) const {
    glm::dvec3 sum(0);
    for (int k = 0; k < count(); ++k)
      for (int colour = 0; colour < 3; ++colour) sum[colour] += reader.scattering(turned(at, k), colour) / count();
    return sum;
  }

 private:
  int count() const { return width_ > 0 ? 8 : 1; }
  bsdf::Point turned(bsdf::Point at, int k) const {
    at.phi = std::abs(at.phi + ((k + 0.5) / count() - 0.5) * width_);
    if (at.phi > std::numbers::pi) at.phi = 2 * std::numbers::pi - at.phi;
    return at;
  }
  Result<std::vector<glm::dvec3>> of_many(const Evaluate& evaluate, std::span<const bsdf::Point> points) const {
    std::vector<bsdf::Point> all;
    for (const bsdf::Point& at : points)
      for (int k = 0; k < count(); ++k) all.push_back(turned(at, k));
    std::vector<glm::dvec3> values(all.size()), means(points.size(), glm::dvec3(0));
    CUTICLE_TRY(evaluate({bsdf::Quantity::S, -1, all}, values));
    for (std::size_t i = 0; i < all.size(); ++i) means[i / std::size_t(count())] += values[i] / double(count());
    return means;
  }

  double width_;
};

Result<Scattering> scattering_at(const Source& source, const TableSet& set, std::span<const bsdf::Point> points) {
  const ScatteringReader reader(set);
  const TexelMeans means(set);
  Scattering result;
  CUTICLE_ASSIGN(result.exact, means.of_model(source, points));
  if (!has_source(set, ChannelSource::solver)) {
    CUTICLE_ASSIGN(result.assumed, assumed_scattering(source, set, reader, points));
  }
  for (const bsdf::Point& at : points) result.stored.push_back(means.of_tables(reader, at));
  return result;
}

std::vector<ChannelError> compare(const std::vector<glm::dvec3>& made, const std::vector<glm::dvec3>& exact) {
  std::vector<ChannelError> errors;
  for (int colour = 0; colour < 3 && !made.empty(); ++colour) {
    Comparison comparison;
    for (std::size_t i = 0; i < made.size(); ++i)
      comparison.add(made[i][colour] - exact[i][colour], exact[i][colour], 1);
    errors.push_back(summarise(fmt::format("S.{}", k_colours[colour]), comparison, k_directions));
  }
  return errors;
}

}  // namespace

Result<void> certify_scattering(const Source& source, TableSet& set) {
  if (set.layout->terms.empty()) return {};
  std::vector<bsdf::Point> points = directions(source);
  std::erase_if(points,
                [reader = ScatteringReader(set)](const bsdf::Point& at) { return reader.filters_singular(at); });
  CUTICLE_ASSIGN(const Scattering scattering, scattering_at(source, set, points));
  set.assumption = compare(scattering.assumed, scattering.exact);
  set.scattering = compare(scattering.stored, scattering.exact);
  return {};
}

Result<double> assumption_error(const Source& source, const Layout& layout) {
  constexpr std::size_t k_few = 16, k_many = 512;
  std::vector<bsdf::Point> points = directions(1);
  points.resize(source.model->loop_rounds ? k_few : k_many);
  TableSet set;
  set.layout = &layout;
  for (const TableLayout& table : layout.tables) {
    set.tables.push_back(empty_table(table, 16));
    set.tables.back().caustic_index = source.caustic_index;
  }
  CUTICLE_ASSIGN(const std::vector<glm::dvec3> made, assumed_scattering(source, set, ScatteringReader(set), points));
  std::vector<glm::dvec3> exact(points.size());
  CUTICLE_TRY(source.evaluate({bsdf::Quantity::S, -1, points}, exact));
  double worst = 0;
  for (const ChannelError& error : compare(made, exact))
    worst = std::max(worst, relative_error(error.rms, error.signal_rms));
  return worst;
}

}  // namespace cuticle::lut
