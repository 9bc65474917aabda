#pragma once
// The registered studies. Each stands in study/NAME/NAME_entry.cpp (with a device: NAME_entry_gpu.cpp), which CMake
// finds, as a function NAME_entry().
#include <span>

#include "study/engine/study.h"

namespace cuticle::study {

/// All studies of this build, in the order of their names.
std::span<const StudyEntry* const> studies();

}  // namespace cuticle::study
