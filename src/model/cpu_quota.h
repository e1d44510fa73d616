// How many processors' worth of time a container grants this process.
#pragma once

#include <filesystem>
#include <optional>

namespace raywise {

// The smallest cgroup limit, version 2 or 1, of this process's group and the groups around it; empty without a limit.
// membership: which groups the process is in; mount: where their files are. Others in tests.
std::optional<double> cpu_quota(const std::filesystem::path& membership = "/proc/self/cgroup",
                                const std::filesystem::path& mount = "/sys/fs/cgroup");

} // namespace raywise
