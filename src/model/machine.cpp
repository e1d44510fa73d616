#include "model/machine.h"

#include "base/instruction_set.h"
#include "base/parallel.h"
#include "model/cache_sizes.h"
#include "model/cpu_identity.h"
#include "model/cpu_quota.h"

#include <algorithm>
#include <cmath>

namespace raywise {
namespace {

// Runs of anything but letters and digits become one '-': the key is a file name on every system.
std::string plain(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c >= 'A' && c <= 'Z') {
            result += static_cast<char>(c - 'A' + 'a');
        } else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) {
            result += c;
        } else if (!result.empty() && result.back() != '-') {
            result += '-';
        }
    }
    while (!result.empty() && result.back() == '-') result.pop_back();
    return result.empty() ? "unknown" : result;
}

std::string size_text(std::uint64_t bytes) {
    constexpr std::uint64_t mebi = std::uint64_t{1} << 20;
    return bytes % mebi == 0 ? std::to_string(bytes / mebi) + "m" : std::to_string(bytes >> 10) + "k";
}

unsigned usable_threads() {
    const unsigned threads = Parallel::usable_threads();
    const std::optional<double> quota = cpu_quota();
    if (!quota || *quota >= threads) return threads;
    return std::max(1u, static_cast<unsigned>(std::ceil(*quota)));
}

} // namespace

Machine look_at_machine() {
    const CpuIdentity cpu = cpu_identity();
    const CacheSizes caches = cache_sizes();
    Machine machine;
    machine.vendor = cpu.vendor;
    machine.brand = cpu.brand;
    machine.family = cpu.family;
    machine.model = cpu.model;
    machine.stepping = cpu.stepping;
    machine.instruction_set = instruction_set();
    machine.l1_bytes = caches.l1;
    machine.l2_bytes = caches.l2;
    machine.l3_bytes = caches.l3;
    machine.threads = usable_threads();
    machine.virtualised = cpu.virtualised;
    return machine;
}

std::string Machine::key() const {
    return plain(vendor) + "-" + std::to_string(family) + "-" + std::to_string(model) + "-" + std::to_string(stepping) +
           "-" + plain(instruction_set) + "-l3-" + size_text(l3_bytes) + "-t" + std::to_string(threads);
}

const Machine& this_machine() {
    static const Machine machine = look_at_machine();
    return machine;
}

} // namespace raywise
