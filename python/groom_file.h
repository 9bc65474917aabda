#pragma once
// Hair that was made, as what a file would have given.
#include "strands/formats/formats.h"

namespace cuticle::python {

inline strands::GroomFile in_file(strands::Groom groom, std::vector<std::string> notes = {}) {
  strands::GroomFile file;
  file.groom = std::move(groom);
  file.notes = std::move(notes);
  file.has_radii = true;
  return file;
}

}  // namespace cuticle::python
