#include "sim/rod/strand_energy.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "sim/rod/hinge_energy.h"
#include "sim/rod/kernel.h"

namespace cuticle::sim::rod {
namespace {

using chains::k_lanes;

glm::dvec3 direction_of(const glm::dquat& frame) { return frame * glm::dvec3(0, 0, 1); }

glm::dquat frame_of(const glm::dvec3& direction, const glm::dvec3& director) {
  const glm::dvec3 x = glm::normalize(director - direction * glm::dot(director, direction));
  return glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(direction, x), direction)));
}

/// The turn between two links about an axis across both.
glm::dquat least_turn(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dquat turn(1 + glm::dot(from, to), glm::cross(from, to));
  if (glm::dot(turn, turn) > 1e-12) return glm::normalize(turn);
  const glm::dvec3 axis = std::abs(from.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::dquat(0, glm::normalize(glm::cross(from, axis)));
}

/// [v]x: what it does to a vector is v's cross product with it.
glm::dmat3 crossing(const glm::dvec3& v) { return {{0, v.z, -v.y}, {-v.z, 0, v.x}, {v.y, -v.x, 0}}; }

struct HingeDerivatives {
  glm::dvec3 gradient{0};  ///< by the child's turn, world axes; the parent's is its negative
  glm::dmat3 second{0};    ///< by the difference of both turns
};
HingeDerivatives derivatives_of(const HingeEnergy& hinge, const glm::dquat& parent, const glm::dquat& child) {
  const glm::dquat q = nearer_twist(hinge, glm::conjugate(parent) * child);
  // A turn u of the child, in the parent's axes, adds (0, u) q / 2.
  const SecondOrder w{q.w, glm::dvec3(-q.x, -q.y, -q.z) * 0.5}, x{q.x, glm::dvec3(q.w, q.z, -q.y) * 0.5},
      y{q.y, glm::dvec3(-q.z, q.w, q.x) * 0.5}, z{q.z, glm::dvec3(q.y, -q.x, q.w) * 0.5};
  const SecondOrder energy = hinge_energy(hinge, w, x, y, z);
  const glm::dmat3 axes = glm::mat3_cast(parent);
  return {axes * energy.first, axes * energy.second * glm::transpose(axes)};
}

/// A place pressed out: the energy's derivatives by it.
struct Press {
  double energy = 0;
  glm::dvec3 gradient{0};
  glm::dmat3 second{0};
};
glm::dvec3 normal_at(const PlacedCollider& collider, const glm::dvec3& place) {
  constexpr double k_apart = 1e-6;  // metres
  glm::dvec3 normal;
  for (int c = 0; c < 3; ++c) {
    glm::dvec3 step(0);
    step[c] = k_apart;
    normal[c] = (distance(collider, place + step) - distance(collider, place - step)) / (2 * k_apart);
  }
  return normal;
}
Press press_at(const Contacts& contacts, const glm::dvec3& place, double clearance) {
  Press press;
  for (const PlacedCollider& collider : contacts.near) {
    const double depth = distance(collider, place) - clearance;
    if (!(depth < 0)) continue;
    const glm::dvec3 normal = normal_at(collider, place);
    press.energy += contacts.stiffness / 2 * depth * depth;
    press.gradient += contacts.stiffness * depth * normal;
    press.second += glm::outerProduct(normal, normal) * contacts.stiffness;
  }
  return press;
}
double press_energy(const Contacts& contacts, const glm::dvec3& place, double clearance) {
  double energy = 0;
  for (const PlacedCollider& collider : contacts.near) {
    const double depth = std::min(0.0, distance(collider, place) - clearance);
    energy += contacts.stiffness / 2 * depth * depth;
  }
  return energy;
}

/// What lies beyond a link, by where its far end moves (x) and how it turns (t): gradient and second derivatives.
struct Beyond {
  glm::dmat3 xx{0}, xt{0}, tt{0};
  glm::dvec3 x{0}, t{0};
};
/// A turn eliminated: t = -inverse (gradient + from_place^T x + from_parent^T parent's turn).
struct Eliminated {
  glm::dmat3 inverse{0}, from_place{0}, from_parent{0};
  glm::dvec3 gradient{0};
};

/// Whether a symmetric matrix is positive definite, by its pivots.
bool is_definite(const glm::dmat3& m) {
  const double a = m[0][0];
  if (!(a > 0)) return false;
  const double b = m[1][1] - m[0][1] * m[0][1] / a;
  if (!(b > 0)) return false;
  const double off = m[1][2] - m[0][1] * m[0][2] / a;
  return m[2][2] - m[0][2] * m[0][2] / a - off * off / b > 0;
}

/// The link's far end as its near end and its turn: x = near + turn x arm, and a force's second order of that.
void carry_along(Beyond& beyond, const glm::dvec3& arm, const glm::dvec3& force) {
  const glm::dmat3 by_turn = -crossing(arm), back = glm::transpose(by_turn);
  beyond.tt += back * beyond.xt + glm::transpose(beyond.xt) * by_turn + back * beyond.xx * by_turn;
  beyond.xt += beyond.xx * by_turn;
  beyond.t += back * beyond.x;
  beyond.tt +=
      (glm::outerProduct(force, arm) + glm::outerProduct(arm, force)) * 0.5 - glm::dmat3(1) * glm::dot(force, arm);
}
/// A press on the middle of a link, beside `carry_along`'s whole arm: near + turn x arm / 2.
void press_middle(Beyond& beyond, const glm::dvec3& arm, const Press& press) {
  Beyond half{.xx = press.second, .x = press.gradient};
  carry_along(half, arm * 0.5, press.gradient);
  beyond.xx += half.xx;
  beyond.xt += half.xt;
  beyond.tt += half.tt;
  beyond.x += half.x;
  beyond.t += half.t;
}

class Elimination {
 public:
  Elimination(const RodStrand& strand, const Frames& frames, const Load& load, double shift)
      : strand_(strand), frames_(frames), load_(load), shift_(shift), links_(strand.links() + 1) {
    if (load.contacts) places_ = places_of(strand, frames);
  }

  NewtonStep run() {
    NewtonStep step;
    Beyond beyond;
    for (std::size_t i = strand_.links(); i >= 1; --i)
      if (!eliminate(i, beyond, step)) return step;
    substitute(step);
    return step;
  }

 private:
  /// Link i; `beyond` then belongs to its parent. False where the pivot is not positive; the moments of the links
  /// nearer to the root are then missing.
  bool eliminate(std::size_t i, Beyond& beyond, NewtonStep& step) {
    add_vertex(i, beyond);
    const glm::dvec3 arm = direction_of(frames_[i]) * strand_.lengths[i];
    carry_along(beyond, arm, force_);
    glm::dvec3 moment = glm::cross(arm, force_);
    if (load_.contacts) {
      const glm::dvec3 middle = (places_[i - 1] + places_[i]) * 0.5;
      const Press press = press_at(*load_.contacts, middle, load_.contacts->clearance[2 * i - 1]);
      press_middle(beyond, arm, press);
      moment += glm::cross(arm * 0.5, press.gradient);
      force_ += press.gradient;
    }
    const HingeDerivatives hinge = derivatives_of(strand_.hinges[i], frames_[i - 1], frames_[i]);
    moment += hinge.gradient + passed_on_;
    passed_on_ = -hinge.gradient;
    step.moment = std::max(step.moment, glm::length(moment));
    Eliminated& link = links_[i];
    const glm::dmat3 pivot = beyond.tt + hinge.second + glm::dmat3(shift_);
    if (!is_definite(pivot)) {
      step.is_definite = false;
      return false;
    }
    link.inverse = glm::inverse(pivot);
    link.gradient = beyond.t + hinge.gradient;
    link.from_place = beyond.xt;
    link.from_parent = crossing(hinge.gradient) * 0.5 - hinge.second;
    const glm::dmat3 place = link.from_place * link.inverse, parent = link.from_parent * link.inverse;
    beyond = {beyond.xx - place * glm::transpose(link.from_place), -place * glm::transpose(link.from_parent),
              hinge.second - parent * glm::transpose(link.from_parent), beyond.x - place * link.gradient,
              -hinge.gradient - parent * link.gradient};
    moments_.push_back(moment);
    return true;
  }

  void add_vertex(std::size_t i, Beyond& beyond) {
    glm::dvec3 gradient = -load_.gravity * strand_.masses[i];
    if (load_.contacts) {
      const Press press = press_at(*load_.contacts, places_[i], load_.contacts->clearance[2 * i]);
      gradient += press.gradient;
      beyond.xx += press.second;
    }
    beyond.x += gradient;
    force_ += gradient;
  }

  void substitute(NewtonStep& step) const {
    glm::dvec3 place(0), parent(0);
    step.turns.assign(links_.size(), glm::dvec3(0));
    for (std::size_t i = 1; i < links_.size(); ++i) {
      const Eliminated& link = links_[i];
      parent = -(link.inverse *
                 (link.gradient + glm::transpose(link.from_place) * place + glm::transpose(link.from_parent) * parent));
      step.turns[i] = parent;
      place += glm::cross(parent, direction_of(frames_[i]) * strand_.lengths[i]);
      step.slope += glm::dot(parent, moments_[links_.size() - 1 - i]);
    }
  }

  const RodStrand& strand_;
  const Frames& frames_;
  const Load& load_;
  double shift_;
  std::vector<Eliminated> links_;
  std::vector<glm::dvec3> places_, moments_;  ///< moments: from the tip
  glm::dvec3 force_{0}, passed_on_{0};        ///< energy's derivative by moving all beyond; the hinge below's moment
};

}  // namespace

double RodStrand::length() const {
  double sum = 0;
  for (const double length : lengths) sum += length;
  return sum;
}
double RodStrand::weight(const glm::dvec3& gravity) const {
  double sum = 0;
  for (const double mass : masses) sum += mass;
  return sum * glm::length(gravity);
}

template <class Real>
RodStrand rod_strand(const chains::Chains<Real>& chains, const chains::Rows<Real>& hinges, std::size_t strand) {
  namespace rest_row = chains::rest_row;
  const chains::ChainPlace& place = chains.places[strand];
  const chains::BlockPlace& block = chains.blocks[place.block];
  const auto own = [&](std::size_t i, int row) {
    return double(hinges[((block.first_vertex + i) * hinge_row::count + std::size_t(row)) * k_lanes + place.lane]);
  };
  const auto vector = [&](int row) { return glm::dvec3(own(0, row), own(0, row + 1), own(0, row + 2)); };
  RodStrand rod{
      {0}, {0}, {{}}, {}, chains::vector_at(chains.strand_at(place.block, chains::strand_row::anchor), place.lane)};
  rod.rest.push_back(frame_of(vector(clamp_row::direction), vector(clamp_row::director)));
  glm::dvec3 from(0);
  for (std::size_t i = 1; i <= block.links; ++i) {
    const auto number = [&](int row) { return double(chains.rest_at(place.block, i, std::size_t(row))[place.lane]); };
    const glm::dvec3 to = chains::vector_at(chains.rest_at(place.block, i, rest_row::target), place.lane);
    const glm::dquat& parent = rod.rest.back();
    rod.rest.push_back(glm::normalize(least_turn(direction_of(parent), glm::normalize(to - from)) * parent));
    from = to;
    rod.lengths.push_back(number(rest_row::length));
    rod.masses.push_back(number(rest_row::mass));
    // A turn about an axis across bends along what is across both: B = (-bend_y, bend_x).
    rod.hinges.push_back({own(i, hinge_row::stiffness), own(i, hinge_row::twist), -own(i, hinge_row::bend_y),
                          own(i, hinge_row::bend_x), own(i, hinge_row::natural_angle)});
  }
  return rod;
}

template RodStrand rod_strand<float>(const chains::Chains<float>&, const chains::Rows<float>&, std::size_t);
template RodStrand rod_strand<double>(const chains::Chains<double>&, const chains::Rows<double>&, std::size_t);

std::vector<glm::dvec3> places_of(const RodStrand& strand, std::span<const glm::dquat> frames) {
  std::vector<glm::dvec3> places = {strand.anchor};
  for (std::size_t i = 1; i < frames.size(); ++i)
    places.push_back(places.back() + direction_of(frames[i]) * strand.lengths[i]);
  return places;
}

Energy energy_of(const RodStrand& strand, const Frames& frames, const Load& load) {
  Energy energy;
  glm::dvec3 place = strand.anchor;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const glm::dquat q = nearer_twist(strand.hinges[i], glm::conjugate(frames[i - 1]) * frames[i]);
    const glm::dvec3 next = place + direction_of(frames[i]) * strand.lengths[i];
    const double bent = hinge_energy(strand.hinges[i], q.w, q.x, q.y, q.z);
    const double lifted = -strand.masses[i] * glm::dot(load.gravity, next - strand.anchor);
    double pressed = 0;
    if (load.contacts)
      pressed = press_energy(*load.contacts, next, load.contacts->clearance[2 * i]) +
                press_energy(*load.contacts, (place + next) * 0.5, load.contacts->clearance[2 * i - 1]);
    energy.value += bent + lifted + pressed;
    energy.magnitude += bent + std::abs(lifted) + pressed;
    place = next;
  }
  return energy;
}

NewtonStep newton_step(const RodStrand& strand, const Frames& frames, const Load& load, double shift) {
  return Elimination(strand, frames, load, shift).run();
}

Frames turned(const Frames& frames, std::span<const glm::dvec3> turns, double share) {
  Frames result = frames;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const glm::dvec3 half = turns[i] * (share / 2);
    const double angle = glm::length(half), sine = angle > 1e-8 ? std::sin(angle) / angle : 1;
    result[i] = glm::normalize(glm::dquat(std::cos(angle), half * sine) * frames[i]);
  }
  return result;
}

}  // namespace cuticle::sim::rod
