#include "model/cache_sizes.h"

#include "base/files.h"
#include "base/words.h"

#include <string>

#include <unistd.h>

namespace raywise {
namespace {

std::string first_word(const std::filesystem::path& path) {
    const std::string content = content_or_nothing(path);
    std::string_view words = content;
    return std::string(take_word(words));
}

// "48K", "1024K", "32M"
std::uint64_t bytes_in(const std::string& text) {
    std::uint64_t value = 0;
    std::size_t i = 0;
    for (; i < text.size() && text[i] >= '0' && text[i] <= '9' && i < 12; ++i) {
        value = value * 10 + static_cast<std::uint64_t>(text[i] - '0');
    }
    if (i < text.size() && text[i] == 'K') return value << 10;
    if (i < text.size() && text[i] == 'M') return value << 20;
    if (i < text.size() && text[i] == 'G') return value << 30;
    return value;
}

std::uint64_t from_sysconf(int name) {
    const long value = ::sysconf(name);
    return value > 0 ? static_cast<std::uint64_t>(value) : 0;
}

} // namespace

CacheSizes cache_sizes(const std::filesystem::path& root) {
    CacheSizes sizes;
    for (int index = 0; index < 16; ++index) { // more than any processor lists
        const std::filesystem::path folder = root / ("index" + std::to_string(index));
        const std::string level = first_word(folder / "level");
        if (level.empty()) break;
        if (first_word(folder / "type") == "Instruction") continue;
        const std::uint64_t bytes = bytes_in(first_word(folder / "size"));
        if (level == "1") sizes.l1 = bytes;
        if (level == "2") sizes.l2 = bytes;
        if (level == "3") sizes.l3 = bytes;
    }
#ifdef _SC_LEVEL1_DCACHE_SIZE
    if (sizes.l1 == 0) {
        sizes.l1 = from_sysconf(_SC_LEVEL1_DCACHE_SIZE);
        sizes.l2 = from_sysconf(_SC_LEVEL2_CACHE_SIZE);
        sizes.l3 = from_sysconf(_SC_LEVEL3_CACHE_SIZE);
    }
#endif
    return sizes;
}

} // namespace raywise
