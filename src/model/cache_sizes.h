// Bytes of data cache per level.
#pragma once

#include <cstdint>
#include <filesystem>

namespace raywise {

struct CacheSizes {
    std::uint64_t l1 = 0;
    std::uint64_t l2 = 0;
    std::uint64_t l3 = 0;
};

// Of the first processor. Zero where the system does not tell.
// root: where the system describes caches; another folder in tests.
CacheSizes cache_sizes(const std::filesystem::path& root = "/sys/devices/system/cpu/cpu0/cache");

} // namespace raywise
