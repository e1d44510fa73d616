// Who made the processor and which one it is.
#pragma once

#include <string>
#include <string_view>

namespace raywise {

struct CpuIdentity {
    std::string vendor;
    std::string brand;
    unsigned family = 0;
    unsigned model = 0;
    unsigned stepping = 0;
    bool virtualised = false;
};

// By the CPUID instruction on x86, from /proc/cpuinfo elsewhere.
CpuIdentity cpu_identity();

// The identity of an ARM processor from the text of /proc/cpuinfo: the first processor's implementer is the vendor, its
// architecture the family, its part the model, 16 * variant + revision the stepping.
CpuIdentity arm_identity(std::string_view cpuinfo);

} // namespace raywise
