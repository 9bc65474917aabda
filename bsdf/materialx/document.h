#pragma once
// Values of the inputs of hair nodes in a parsed document, through the connections between them.
#include <pugixml.hpp>

#include "bsdf/materialx/nodes.h"
#include "core/result.h"

namespace cuticle::bsdf::materialx {

/// A node of the document that is known, with all its inputs checked. Error: bad_input, naming the node and its input.
class HairNode {
 public:
  static Result<HairNode> make(const pugi::xml_node& element, std::string_view file);
  const NodeSpec& spec() const { return *spec_; }
  /// What an input gives: its numbers, or those of the node that it is connected to.
  Result<Numbers> value(std::string_view input) const;

 private:
  HairNode(pugi::xml_node element, const NodeSpec& spec, std::string where)
      : element_(element), spec_(&spec), where_(std::move(where)) {}
  Result<void> check_inputs() const;
  Result<Numbers> number_value(const InputSpec& input, const pugi::xml_node& element) const;
  Result<Numbers> connected_value(const InputSpec& input, const pugi::xml_node& element) const;

  pugi::xml_node element_;
  const NodeSpec* spec_;
  std::string where_;  ///< "file.mtlx: chiang_hair_bsdf 'hair'"
};

}  // namespace cuticle::bsdf::materialx
