#pragma once
// The control points of a groom's curves; for the sources of strands/rays alone.
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "strands/groom.h"
#include "strands/rays/curve_span.h"

namespace cuticle::strands {

/// Where on a strand: the way from a vertex to the next.
struct CurvePlace {
  std::uint32_t strand = 0, vertex = 0;
  double share = 0;
};

class CurveSet {
 public:
  CurveSet() = default;
  /// `positions_at_end`: at time 1; empty: nothing moves.
  CurveSet(const Groom& groom, std::span<const glm::vec3> positions_at_end, CurveKind kind);

  /// Position and radius; two more for each strand where the curve needs them beyond its ends.
  std::span<const glm::vec4> controls() const { return controls_; }
  std::span<const glm::vec4> controls_at_end() const { return controls_at_end_; }
  /// The first control of each span that has a length.
  std::span<const std::uint32_t> first() const { return first_; }
  CurveSpan span(std::uint32_t primitive, double time) const { return span_from(first_[primitive], time); }
  CurveSpan span_at(const CurvePlace& place, double time) const { return span_from(first_control(place), time); }
  /// The place of the parameter u of a span, and back.
  CurvePlace place(std::uint32_t primitive, double u) const;
  double parameter(const CurvePlace& place) const;
  std::uint32_t strand(std::uint32_t primitive) const { return places_[primitive].strand; }

 private:
  CurveSpan span_from(std::uint32_t first, double time) const;
  std::uint32_t first_control(const CurvePlace& place) const;
  std::vector<glm::vec4> controls_of(const Groom& groom, std::span<const glm::vec3> positions) const;
  int vertices_of_span() const { return kind_.basis == SplineBasis::bezier ? 3 : 1; }

  CurveKind kind_;
  std::vector<std::uint32_t> offsets_, first_;
  std::vector<CurvePlace> places_;  ///< of the spans' beginnings
  std::vector<glm::vec4> controls_, controls_at_end_;
};

}  // namespace cuticle::strands
