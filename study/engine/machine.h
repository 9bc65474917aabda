#pragma once
// Where and with what a result was made.
#include <string>

#include "core/json/json.h"

namespace cuticle::study {

/// Processor, threads, system, compiler, build type, version and commit of this build; `device` and `driver` as given.
Json machine_json(const std::string& device, const std::string& driver);

}  // namespace cuticle::study
