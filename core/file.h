#pragma once
// Whole files in and out. Writing goes to a temporary name beside the target and is renamed, so no partial file is left.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/output_file.h"
#include "core/result.h"

namespace cuticle {

/// The bytes of a file, a pipe or a device, up to its end. Error: bad_input naming the file and the system's reason, or
/// that it is longer than memory_limit().
Result<std::vector<std::byte>> read_file(const std::string& path);
Result<std::string> read_text_file(const std::string& path);

/// Writes all bytes or nothing, by the rules of output_file.h.
Result<void> write_file(const std::string& path, std::span<const std::byte> bytes);
Result<void> write_text_file(const std::string& path, std::string_view text);

/// Makes a folder and its parents. Error: bad_input naming it.
Result<void> make_folder(const std::string& path);

}  // namespace cuticle
