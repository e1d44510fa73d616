#include "model/cpu_identity.h"

#include "base/files.h"
#include "base/words.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#define RW_HAS_CPUID 1
#endif

namespace raywise {
namespace {

std::string trimmed(const std::string& text) {
    const char* blanks = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

#ifdef RW_HAS_CPUID

struct Registers {
    unsigned a = 0, b = 0, c = 0, d = 0;
};

Registers cpuid(unsigned leaf) {
    Registers r;
    __get_cpuid_count(leaf, 0, &r.a, &r.b, &r.c, &r.d);
    return r;
}

void append(std::string& text, unsigned word) {
    char bytes[sizeof(word)];
    std::memcpy(bytes, &word, sizeof(word));
    text.append(bytes, sizeof(bytes));
}

CpuIdentity x86_identity() {
    CpuIdentity cpu;
    const Registers leaf0 = cpuid(0);
    append(cpu.vendor, leaf0.b);
    append(cpu.vendor, leaf0.d);
    append(cpu.vendor, leaf0.c);

    // Family and model have an extension each, which counts only for some base families.
    const Registers leaf1 = cpuid(1);
    const unsigned base_family = leaf1.a >> 8 & 0xF;
    const unsigned base_model = leaf1.a >> 4 & 0xF;
    cpu.stepping = leaf1.a & 0xF;
    cpu.family = base_family == 0xF ? base_family + (leaf1.a >> 20 & 0xFF) : base_family;
    cpu.model = base_family == 0x6 || base_family == 0xF ? base_model + ((leaf1.a >> 16 & 0xF) << 4) : base_model;
    cpu.virtualised = (leaf1.c >> 31 & 1) != 0;

    if (cpuid(0x80000000u).a >= 0x80000004u) {
        for (const unsigned leaf : {0x80000002u, 0x80000003u, 0x80000004u}) {
            const Registers r = cpuid(leaf);
            for (const unsigned word : {r.a, r.b, r.c, r.d}) append(cpu.brand, word);
        }
        cpu.brand = trimmed(cpu.brand.c_str()); // up to the first zero
    }
    return cpu;
}

#endif

unsigned number(const std::string& text) { return static_cast<unsigned>(std::strtoul(text.c_str(), nullptr, 0)); }

} // namespace

CpuIdentity arm_identity(std::string_view cpuinfo) {
    std::map<std::string, std::string> facts;
    while (!cpuinfo.empty()) {
        const std::string line(take_line(cpuinfo));
        const std::size_t colon = line.find(':');
        if (colon != std::string::npos) facts.emplace(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
    }
    CpuIdentity cpu;
    const std::string implementer = facts["CPU implementer"];
    cpu.vendor = implementer.empty() ? "unknown" : "arm-" + implementer;
    cpu.brand = facts["model name"].empty() ? facts["Hardware"] : facts["model name"];
    cpu.family = number(facts["CPU architecture"]);
    cpu.model = number(facts["CPU part"]);
    cpu.stepping = number(facts["CPU variant"]) * 16 + number(facts["CPU revision"]);
    return cpu;
}

CpuIdentity cpu_identity() {
#ifdef RW_HAS_CPUID
    return x86_identity();
#else
    return arm_identity(content_or_nothing("/proc/cpuinfo"));
#endif
}

} // namespace raywise
