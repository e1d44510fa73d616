// What a case may expect of the answers to a ray.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace raywise::contract {

struct PrimitiveId {
    std::uint32_t geometry = 0;
    std::uint32_t primitive = 0;
};
inline bool operator==(const PrimitiveId& a, const PrimitiveId& b) {
    return a.geometry == b.geometry && a.primitive == b.primitive;
}

enum class Expected {
    hit,        // something is hit
    miss,       // nothing is
    t,          // the closest hit is there
    primitive,  // the closest hit is one of these triangles
    lowest,     // the closest hit is this triangle, the lowest id of those hit at the same t
    count,      // all hits are so many
    even,       // all hits are an even number: the ray starts and ends outside a closed mesh
    odd,        // an odd number: it starts inside
    inside,     // as odd: how a point is found to be inside
    outside,    // as even
    all_t,      // all hits are there
    exact,      // hit or miss, t and triangle are those of exact arithmetic
    plane,      // the point hit lies on the triangle that is named
    batch,      // the same bits when asked in one batch, forwards and backwards
    repeatable, // the same bits when asked again
};

struct Expectation {
    Expected kind = Expected::hit;
    std::vector<double> numbers;
    std::vector<PrimitiveId> ids;
    int line = 0;
};

// One row per kind: how it is written, what it takes, and which of a library's calls it needs.
struct ExpectationKind {
    Expected kind;
    const char* word;
    enum class Takes {
        nothing,
        one_number,
        count,
        numbers,
        ids,
        one_id
    } takes;
    bool needs_all;
    bool for_sweeps; // makes sense for every ray of a sweep
};
const std::vector<ExpectationKind>& expectation_kinds();
const ExpectationKind& describe(Expected kind);

// As it is written in a case file, without "expect".
std::string text_of(const Expectation& expectation);

} // namespace raywise::contract
