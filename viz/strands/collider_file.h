#pragma once
// colliders.json: where the colliders and the head of a run stand in each frame. Needs no VTK.
#include <map>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/json/json.h"
#include "sim/colliders/placed.h"

namespace cuticle::viz {

/// Written beside a run's states while it goes on. Distance fields become collider_field_K.vti, in their own frames.
class ColliderWriter {
 public:
  /// What stands where at the end of a frame; the first call says which shapes there are. Error: of writing a field.
  Result<void> add(int frame, std::span<const sim::PlacedCollider> colliders, const glm::dmat4& head,
                   const std::string& folder);
  bool empty() const { return shapes_.size() == 0; }
  std::string text() const;
  /// Files beside colliders.json.
  const std::vector<std::string>& fields() const { return fields_; }

 private:
  Json shapes_ = Json::list(), frames_ = Json::list();
  std::vector<std::string> fields_;
};

/// A distance field as a .vti file, where it is placed.
std::string format_field(const sim::DistanceField& field, const Placement& place = {});

/// As read.
struct RunColliders {
  std::vector<sim::PlacedCollider> shapes;       ///< their places are not set
  std::map<int, std::vector<Placement>> places;  ///< by the number of a state, one for each shape
  std::map<int, glm::dmat4> heads;               ///< rest -> world
  /// Placed as in that state; none where the file does not tell.
  std::vector<sim::PlacedCollider> at(int frame) const;
};
/// Of a run's folder; of one without the file: nothing. Error: bad_input naming the file and what is wrong in it.
Result<RunColliders> read_colliders(const std::string& folder);

}  // namespace cuticle::viz
