#include "model/cpu_quota.h"

#include "base/files.h"
#include "base/words.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace raywise {
namespace {

void lower_to(std::optional<double>& limit, double value) {
    if (value > 0.0) limit = limit ? std::min(*limit, value) : value;
}

std::optional<double> next_number(std::string_view& words) { return number_of<double>(take_word(words)); }

std::optional<double> number_in(const std::filesystem::path& path) {
    const std::string content = content_or_nothing(path);
    std::string_view words = content;
    return next_number(words);
}

void lower_to_quota(std::optional<double>& limit, std::optional<double> quota, std::optional<double> period) {
    if (quota && period && *period > 0.0) lower_to(limit, *quota / *period);
}

// Version 2: "max 100000" or "150000 100000", quota and period in microseconds. "max" is no number: no limit.
void read_version_2(const std::filesystem::path& group, std::optional<double>& limit) {
    const std::string content = content_or_nothing(group / "cpu.max");
    std::string_view words = content;
    const std::optional<double> quota = next_number(words);
    lower_to_quota(limit, quota, next_number(words));
}

// Version 1: two files; a quota of -1 means none.
void read_version_1(const std::filesystem::path& group, std::optional<double>& limit) {
    lower_to_quota(limit, number_in(group / "cpu.cfs_quota_us"), number_in(group / "cpu.cfs_period_us"));
}

bool names_cpu(std::string_view controllers) {
    while (!controllers.empty()) {
        if (take_before(controllers, ',') == "cpu") return true;
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
    const std::string content = content_or_nothing(membership);
    std::string_view lines = content;
    while (!lines.empty()) { // hierarchy:controllers:path
        std::string_view line = take_line(lines);
        if (std::count(line.begin(), line.end(), ':') < 2) continue;
        take_before(line, ':');
        const std::string_view controllers = take_before(line, ':');
        const std::string group(line);
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
