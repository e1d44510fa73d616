#include "model/cpu_quota.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

namespace raywise {
namespace {

void lower_to(std::optional<double>& limit, double value) {
    if (value > 0.0) limit = limit ? std::min(*limit, value) : value;
}

// Version 2: "max 100000" or "150000 100000", quota and period in microseconds.
void read_version_2(const std::filesystem::path& group, std::optional<double>& limit) {
    std::ifstream file(group / "cpu.max");
    double quota = 0.0, period = 0.0;
    if (file >> quota >> period && period > 0.0) lower_to(limit, quota / period); // "max" is no number: no limit
}

// Version 1: two files; a quota of -1 means none.
void read_version_1(const std::filesystem::path& group, std::optional<double>& limit) {
    std::ifstream quota_file(group / "cpu.cfs_quota_us"), period_file(group / "cpu.cfs_period_us");
    double quota = 0.0, period = 0.0;
    if (quota_file >> quota && period_file >> period && period > 0.0) lower_to(limit, quota / period);
}

bool names_cpu(const std::string& controllers) {
    std::istringstream list(controllers);
    for (std::string name; std::getline(list, name, ',');) {
        if (name == "cpu") return true;
    }
    return false;
}

// Calls read for the group and every group around it. Inside a container the path may be the host's and not exist
// here; the mount's root is then the container's own group.
template <class Read>
void walk_up(const std::filesystem::path& mount, const std::string& group, Read read) {
    std::filesystem::path relative = std::filesystem::path(group).relative_path().lexically_normal();
    while (!relative.empty() && relative != ".") {
        read(mount / relative);
        relative = relative.parent_path();
    }
    read(mount);
}

} // namespace

std::optional<double> cpu_quota(const std::filesystem::path& membership, const std::filesystem::path& mount) {
    std::optional<double> limit;
    std::ifstream file(membership);
    for (std::string line; std::getline(file, line);) { // hierarchy:controllers:path
        const std::size_t first = line.find(':');
        const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const std::string group = line.substr(second + 1);
        if (controllers.empty()) {
            walk_up(mount, group, [&](const std::filesystem::path& path) { read_version_2(path, limit); });
        } else if (names_cpu(controllers)) {
            for (const char* name : {"cpu", "cpu,cpuacct"}) {
                walk_up(mount / name, group, [&](const std::filesystem::path& path) { read_version_1(path, limit); });
            }
        }
    }
    return limit;
}

} // namespace raywise
