#include "lut/cell_average.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <glm/common.hpp>

namespace cuticle::lut {
namespace {

constexpr int k_nodes = 17;  ///< of the 15-point rule, between the two ends
constexpr double k_tolerance = 5e-6;
constexpr int k_early = 8;                ///< halvings after which what has not converged is a caustic
constexpr int k_halvings = 36;            ///< at most: a cell of 0.01 rad is then cut near the spacing of double
constexpr std::size_t k_max_pieces = 64;  ///< of each interval at one level: a term that is noise converges nowhere
constexpr std::size_t k_pieces_at_once = 16384;

/// Nodes on [-1, 1] with the weights of both rules (0 where a rule has no node). The ends have no weight: they show a
/// peak that stands between an end and its neighbour.
struct Rule {
  std::array<double, k_nodes> node{}, kronrod{}, gauss{};
};
Rule make_rule() {
  const auto& nodes = boost::math::quadrature::gauss_kronrod<double, 15>::abscissa();
  const auto& weights = boost::math::quadrature::gauss_kronrod<double, 15>::weights();
  const auto& inner = boost::math::quadrature::gauss<double, 7>::weights();
  Rule rule;
  for (int i = 1; i + 1 < k_nodes; ++i) {
    const int half = std::abs(i - k_nodes / 2);
    rule.node[i] = i < k_nodes / 2 ? -nodes[half] : nodes[half];
    rule.kronrod[i] = weights[half];
    rule.gauss[i] = half % 2 == 0 ? inner[half / 2] : 0;
  }
  rule.node.front() = -1;
  rule.node.back() = 1;
  return rule;
}

struct Piece {
  std::uint32_t interval = 0;
  double begin = 0, end = 0;
};

std::vector<bsdf::Point> points_of(const Rule& rule, std::span<const Piece> pieces,
                                   std::span<const PhiInterval> intervals) {
  std::vector<bsdf::Point> points;
  points.reserve(pieces.size() * k_nodes);
  for (const Piece& piece : pieces)
    for (double node : rule.node) {
      bsdf::Point& point = points.emplace_back();
      point.theta_d = intervals[piece.interval].theta_d;
      point.phi = (piece.begin + piece.end) / 2 + node * (piece.end - piece.begin) / 2;
    }
  return points;
}

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

/// The part of an interval's mean that a piece gives, and its error estimate.
struct Share {
  glm::dvec3 mean{0};
  double error = 0;
};
Share share_of(const Rule& rule, const Piece& piece, const PhiInterval& interval, std::span<const glm::dvec3> values) {
  glm::dvec3 fine(0), coarse(0);
  for (int i = 0; i < k_nodes; ++i) {
    fine += rule.kronrod[i] * values[i];
    coarse += rule.gauss[i] * values[i];
  }
  const double width = (piece.end - piece.begin) / (interval.end - interval.begin) / 2,
               gap = 1 - rule.node[k_nodes - 2];
  const glm::dvec3 ends = glm::abs(values[0] - values[1]) + glm::abs(values[k_nodes - 1] - values[k_nodes - 2]);
  return {fine * width, largest(glm::abs(fine - coarse) + ends * gap) * width};
}

/// The pieces of one level of halving: each is added to its interval's mean or split in two.
class Averager {
 public:
  Averager(const Source& source, const Channel& channel, std::span<const PhiInterval> intervals)
      : source_(source), channel_(channel), intervals_(intervals), rule_(make_rule()) {
    result_.values.assign(intervals.size(), glm::dvec3(0));
    result_.singular.assign(intervals.size(), 0);
    for (std::uint32_t i = 0; i < intervals.size(); ++i) pieces_.push_back({i, intervals[i].begin, intervals[i].end});
  }
  Result<PhiAverages> run() {
    for (int level = 0; !pieces_.empty(); ++level) CUTICLE_TRY(advance(level));
    return std::move(result_);
  }

 private:
  Result<void> advance(int level) {
    const std::vector<Piece> pieces = std::exchange(pieces_, {});
    const bool last = level >= k_halvings || pieces.size() > k_max_pieces * intervals_.size();
    for (std::size_t first = 0; first < pieces.size(); first += k_pieces_at_once) {
      const auto part = std::span(pieces).subspan(first, std::min(k_pieces_at_once, pieces.size() - first));
      const Evaluate& evaluate = level > k_early ? source_.evaluate_in_double : source_.evaluate;
      CUTICLE_ASSIGN(const std::vector<glm::dvec3> values,
                     evaluate_points(*source_.model, evaluate, channel_, points_of(rule_, part, intervals_)));
      for (std::size_t i = 0; i < part.size(); ++i)
        settle(level, last, part[i], std::span(values).subspan(i * k_nodes, k_nodes));
    }
    return {};
  }
  void settle(int level, bool last, const Piece& piece, std::span<const glm::dvec3> values) {
    const Share share = share_of(rule_, piece, intervals_[piece.interval], values);
    glm::dvec3& mean = result_.values[piece.interval];
    const bool converged = !(share.error > k_tolerance * largest(mean + share.mean));  // also when not a number
    if (!converged && level >= k_early) result_.singular[piece.interval] = 1;
    if (converged || last) {
      mean += share.mean;
      return;
    }
    const double middle = (piece.begin + piece.end) / 2;
    pieces_.push_back({piece.interval, piece.begin, middle});
    pieces_.push_back({piece.interval, middle, piece.end});
  }

  const Source& source_;
  const Channel& channel_;
  std::span<const PhiInterval> intervals_;
  Rule rule_;
  std::vector<Piece> pieces_;
  PhiAverages result_;
};

/// Adds the model's own means of one lobe; false where it has none.
Result<bool> add_means(const Source& source, int lobe, std::span<const PhiInterval> intervals, PhiAverages& sum) {
  std::vector<bsdf::AzimuthMean> means(intervals.size());
  CUTICLE_ASSIGN(const bool exact, source.azimuthal_means(lobe, intervals, means));
  if (!exact) return false;
  for (std::size_t i = 0; i < means.size(); ++i) {
    sum.values[i] += means[i].value;
    sum.singular[i] |= std::uint8_t(means[i].singular);
  }
  return true;
}

/// The model's own means, summed over the channel's lobes; empty where it has none.
Result<PhiAverages> exact_averages(const Source& source, const Channel& channel,
                                   std::span<const PhiInterval> intervals) {
  if (!source.azimuthal_means) return PhiAverages{};
  CUTICLE_ASSIGN(const std::vector<int> lobes, find_lobes(*source.model, channel.lobe));
  PhiAverages sum{std::vector<glm::dvec3>(intervals.size(), glm::dvec3(0)),
                  std::vector<std::uint8_t>(intervals.size(), 0)};
  for (int lobe : lobes) {
    CUTICLE_ASSIGN(const bool exact, add_means(source, lobe, intervals, sum));
    if (!exact) return PhiAverages{};
  }
  return sum;
}

}  // namespace

PhiInterval phi_interval(const TableLayout& table, int size, double u_begin, double u_end, double v) {
  CUTICLE_EXPECT(axis_info(table.u.quantity).angle == &bsdf::Point::phi, "cell averages need phi along u");
  const double first = axis_angle(table.u, size, u_begin), last = axis_angle(table.u, size, u_end);
  return {axis_angle(table.v, size, v), std::min(first, last), std::max(first, last)};
}

Result<PhiAverages> average_over_phi(const Source& source, const Channel& channel,
                                     std::span<const PhiInterval> intervals) {
  CUTICLE_ASSIGN(PhiAverages exact, exact_averages(source, channel, intervals));
  if (exact.values.size() == intervals.size()) return exact;
  return Averager(source, channel, intervals).run();
}

}  // namespace cuticle::lut
