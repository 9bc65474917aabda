#pragma once
// Running a registered study from the command line.
#include <string>

#include "core/progress.h"
#include "study/engine/run.h"

namespace cuticle::cli {

/// The entry's options at their defaults.
study::StudyRequest default_request(const study::StudyEntry& entry, bool quick, const std::string& device);
/// Declares, runs and writes into the folder. Gives the lines of study.csv.
Result<std::string> run_registered(const study::StudyEntry& entry, const study::StudyRequest& request,
                                   const std::string& folder, Progress& progress);

}  // namespace cuticle::cli
