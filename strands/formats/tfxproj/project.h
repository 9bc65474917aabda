#pragma once
// TressFX projects (.tfxproj): the .tfx files that together make one hairdo.
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "strands/formats/format.h"

namespace cuticle::strands {

/// The parts of a project, in the order of the file.
struct ProjectParts {
  std::vector<std::string> files;         ///< names of .tfx files, relative to the project's folder
  std::vector<FollowHairs> follow_hairs;  ///< of each, without its strands' numbers
};

/// Parses a project's text; settings of the simulation, spheres and the mesh are skipped. Error: bad_input naming the
/// line: no version 1 <= version < 5, a part outside the project's folder, a part named twice, follow hairs past their
/// range (k_max_follow_hairs; a reach of 0 .. 1e6, a tip separation of -1 .. 1e3), or no part at all.
Result<ProjectParts> parse_project(std::string_view text, const std::string& where);

/// All parts of a project as one groom, in file units, in the order of the file; notes say what each part holds. Root
/// uv and attributes are kept where every part has them.
Result<ParsedGroom> read_project(const std::string& path, Damage damage);

/// The project beside a .tfx file that names it as a part, or "" when there is none. Unreadable projects are passed
/// over.
std::string project_of(const std::string& tfx_path);

}  // namespace cuticle::strands
