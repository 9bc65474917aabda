#pragma once
// The models that `cuticle eval` evaluates, each with its parameters, and how those came from a hair or a material.
#include <optional>
#include <string>
#include <vector>

#include "bsdf/model.h"
#include "cli/eval/absorption.h"

namespace cuticle::cli {

/// A model with its parameters; the mapping where a hair or a material gave them.
struct Subject {
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;
  std::optional<bsdf::FibreMapping> mapping;
};

/// What was asked for: names a,b,c or "all"; settings over a preset, over a named hair, or over a MaterialX file
/// (empty: none).
struct SubjectRequest {
  std::string models, settings, preset, hair, material;
  AbsorptionRequest absorption;  ///< over all of these
};

/// The models asked for. With a hair, "all" leaves out models that map no fibre. Errors: usage, naming the model, hair,
/// parameter or the two options that exclude each other; bad_input of the material's file.
Result<std::vector<Subject>> choose_subjects(const SubjectRequest& request);

/// Which coordinates any of them needs for a quantity.
std::array<bool, bsdf::coordinate_count> needed_coordinates(const std::vector<Subject>& subjects,
                                                            bsdf::Quantity quantity);

}  // namespace cuticle::cli
