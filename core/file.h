#pragma once
// Whole files in and out. Writing goes to a temporary name beside the target and is renamed, so no partial file is left.
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace cuticle {

/// The bytes of a file. Error: bad_input naming the file and the system's reason.
Result<std::vector<std::byte>> read_file(const std::string& path);
Result<std::string> read_text_file(const std::string& path);

/// Writes all bytes or nothing.
Result<void> write_file(const std::string& path, std::span<const std::byte> bytes);
Result<void> write_text_file(const std::string& path, std::string_view text);

/// For writers that need a file name of their own (image libraries): calls `write(temporary)`, then renames to `path`;
/// removes the temporary when `write` fails. The temporary keeps the extension of `path`.
Result<void> write_through_temporary(const std::string& path, const std::function<Result<void>(const std::string&)>& write);

/// Makes a folder and its parents. Error: bad_input naming it.
Result<void> make_folder(const std::string& path);

}  // namespace cuticle
