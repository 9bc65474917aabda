#pragma once
// Models broken on purpose, each with one mistake that published renderers have had, and the same model whole.
#include "study/model_check/gallery/textbook_fibre.h"

namespace cuticle::study::model_check {

/// What hangs in the gallery: Cause::none is the model whole.
std::span<const Cause> gallery();
/// The textbook fibre with that mistake, as a subject of the checks.
Subject exhibit(Cause mistake);

}  // namespace cuticle::study::model_check
