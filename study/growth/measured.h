#pragma once
// What the parts of the study of growth share: the hair, and a time taken once.
#include <ctime>

#include "strands/groom.h"
#include "study/growth/growth.h"

namespace cuticle::study {

/// Strands of 0.25 m on a ball of 0.09 m, evenly spread, that bend down.
strands::Groom ball_of_hair(int strands, int vertices);

/// Processor time of all threads of the program, seconds.
inline double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// What takes so many seconds of processor time is not run again.
inline constexpr double k_slow = 1;

/// A group without errors: a time for each method and number of strands.
Group group_of_times(std::string name, std::string title);
void add_time(Group& group, std::string method, int strands, double seconds);

/// Keeps "WHAT, N strands: REASON" where a size is refused.
void note_refusal(const GrowthRequest& request, std::string_view what, int strands, const Error& error);

}  // namespace cuticle::study
