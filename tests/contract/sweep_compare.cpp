#include "contract/sweep_compare.h"

#include <cstdio>
#include <cstring>

namespace raywise::sweep {
namespace {

// rw_hit has no padding: its bytes are its answer.
static_assert(sizeof(rw_hit) == 3 * sizeof(double) + 4 * sizeof(std::uint32_t), "rw_hit has padding");

bool same_bits(const rw_hit& a, const rw_hit& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

std::string hex(double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%a", x);
    return text;
}
std::string hex(const double (&v)[3]) { return "{" + hex(v[0]) + ", " + hex(v[1]) + ", " + hex(v[2]) + "}"; }

std::string list_of(const AllHits& all, std::size_t ray) {
    constexpr std::uint64_t most = 4;
    const std::uint64_t first = all.offsets[ray];
    const std::uint64_t last = all.offsets[ray + 1];
    std::string text = std::to_string(last - first) + " hits";
    for (std::uint64_t i = first; i < last && i < first + most; ++i) text += "\n        " + text_of(all.hits[i]);
    return text;
}

} // namespace

bool is_hit(const rw_hit& hit) { return hit.primitive != RW_INVALID_ID; }

std::string text_of(const rw_ray& ray) {
    return "origin " + hex(ray.origin) + " direction " + hex(ray.direction) + " tmin " + hex(ray.tmin) + " tmax " +
           hex(ray.tmax);
}

std::string text_of(const rw_hit& hit) {
    if (!is_hit(hit) && hit.t == HUGE_VAL) return "no hit";
    return "primitive " + std::to_string(hit.primitive) + " of geometry " + std::to_string(hit.geometry) + " at t " +
           hex(hit.t) + ", u " + hex(hit.u) + ", v " + hex(hit.v);
}

std::vector<Difference> compare_closest(const std::vector<rw_hit>& wanted, const std::vector<rw_hit>& answers) {
    std::vector<Difference> differences;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        if (same_bits(wanted[i], answers[i])) continue;
        differences.push_back(
            {i, "closest hit\n    wanted  " + text_of(wanted[i]) + "\n    answer  " + text_of(answers[i])});
    }
    return differences;
}

std::vector<Difference> compare_any(const std::vector<rw_hit>& wanted, const std::vector<std::uint8_t>& answers) {
    std::vector<Difference> differences;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        if (answers[i] == (is_hit(wanted[i]) ? 1 : 0)) continue;
        differences.push_back({i, "any hit\n    wanted  " + text_of(wanted[i]) + "\n    answer  " +
                                      std::to_string(static_cast<int>(answers[i]))});
    }
    return differences;
}

std::vector<Difference> compare_all(const AllHits& wanted, const AllHits& answers) {
    std::vector<Difference> differences;
    for (std::size_t i = 0; i + 1 < answers.offsets.size(); ++i) {
        const std::uint64_t count = wanted.offsets[i + 1] - wanted.offsets[i];
        bool same = answers.offsets[i + 1] - answers.offsets[i] == count;
        for (std::uint64_t k = 0; same && k < count; ++k)
            same = same_bits(wanted.hits[wanted.offsets[i] + k], answers.hits[answers.offsets[i] + k]);
        if (same) continue;
        differences.push_back(
            {i, "all hits\n    wanted  " + list_of(wanted, i) + "\n    answer  " + list_of(answers, i)});
    }
    return differences;
}

std::vector<Difference> compare_first(const std::vector<rw_hit>& closest, const AllHits& all) {
    std::vector<Difference> differences;
    for (std::size_t i = 0; i + 1 < all.offsets.size(); ++i) {
        const bool none = all.offsets[i] == all.offsets[i + 1];
        if (none ? !is_hit(closest[i]) : same_bits(closest[i], all.hits[all.offsets[i]])) continue;
        differences.push_back(
            {i, "closest against all hits\n    closest " + text_of(closest[i]) + "\n    all     " + list_of(all, i)});
    }
    return differences;
}

} // namespace raywise::sweep
