// Any text: an error, or parts that lie in the project's folder.
#include <cstdlib>
#include <filesystem>

#include "strands/formats/tfxproj/project.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parts =
      cuticle::strands::parse_project(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
  if (!parts) return 0;
  if (parts->files.empty()) std::abort();
  for (const std::string& file : parts->files)
    if (*(std::filesystem::path("folder") / file).lexically_normal().begin() != "folder") std::abort();
  return 0;
}
