#include "core/interrupt.h"

#include <atomic>

namespace cuticle {
namespace {

std::atomic<int> alive{0};
std::atomic<bool> asked{false};

}  // namespace

StopsBetweenSteps::StopsBetweenSteps() { ++alive; }
StopsBetweenSteps::~StopsBetweenSteps() { --alive; }
bool StopsBetweenSteps::is_asked() const { return asked; }

bool ask_to_stop() { return alive > 0 && !asked.exchange(true); }

bool was_asked_to_stop() { return asked; }

}  // namespace cuticle
