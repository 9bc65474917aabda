#pragma once
// Zip archives in memory, by libzip.
#include <string>
#include <vector>

#include "core/result.h"

namespace cuticle::strands::npz {

struct Member {
  std::string name;
  std::vector<std::byte> bytes;
};

/// All members. Error: bad_input with libzip's reason, or a member that claims more than its compressed bytes can hold.
Result<std::vector<Member>> read_archive(std::span<const std::byte> bytes, const std::string& where);
/// Members stored as they are, dated 1980-01-01: the same members give the same bytes.
Result<std::vector<std::byte>> write_archive(const std::vector<Member>& members);

}  // namespace cuticle::strands::npz
