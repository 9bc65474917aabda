#pragma once
// Which passes a picture needs: compiled backwards from what the scene asks for, along what passes read and write.
#include <span>
#include <string>
#include <vector>

#include "plan/plan.h"

namespace cuticle::plan {

/// Takes the passes out of `plan.passes` whose results nobody reads, or that read what nobody writes, with the reason,
/// sorts the others so that writers come before readers, and fills in `plan.resources`. Passes without uses stay.
void compile(Plan& plan);

}  // namespace cuticle::plan
