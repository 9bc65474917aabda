#include "study/engine/machine.h"

#include <fstream>
#include <thread>

#include <sys/utsname.h>

namespace cuticle::study {
namespace {

/// "model name" of /proc/cpuinfo; empty where the system does not tell.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "";
}

std::string system_name() {
  utsname names{};
  if (uname(&names) != 0) return "";
  return std::string(names.sysname) + " " + names.release + " " + names.machine;
}

}  // namespace

Json machine_json(const std::string& device, const std::string& driver) {
  return {{"processor", processor_name()},
          {"threads", std::thread::hardware_concurrency()},
          {"system", system_name()},
          {"compiler", __VERSION__},
          {"build", CUTICLE_BUILD_TYPE},
          {"version", CUTICLE_VERSION},
          {"commit", CUTICLE_COMMIT},
          {"device", device},
          {"driver", driver}};
}

}  // namespace cuticle::study
