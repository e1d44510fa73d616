// Whether a library's answers to one ray are what was expected, and whether they agree with each other.
#pragma once

#include "contract/exact_hits.h"
#include "contract/expectation.h"
#include "contract/library.h"

#include <optional>
#include <string>
#include <vector>

namespace raywise::contract {

// Everything a library said about one ray.
struct Answers {
    Answer closest;
    std::optional<bool> any;
    std::optional<std::vector<Answer>> all;
};
// Throws Inexpressible when the library cannot be asked for the closest hit; what else it cannot be asked stays empty.
Answers ask(Scene& scene, const Ray& ray, const Capabilities& capabilities);

// What is wrong with them, whatever is expected: any, all and closest are about the same hits. Empty: nothing. `question`
// receives which of them is in doubt: "closest", "any" or "all".
std::string disagreement(const Answers& answers, double t_tolerance, const char*& question);

enum class Verdict {
    met,
    not_met,
    cannot_say, // the library has no call for it
};

// For every kind but `batch` and `repeatable`, which are about a whole group of rays. `why` is set when it is not met.
Verdict check(const Expectation& expectation, const Ray& ray, const Answers& answers, const ExactScene& exact,
              const Capabilities& capabilities, std::string& why);

bool same_bits(const Answer& a, const Answer& b);
std::string text_of(const Answer& answer);
std::string text_of(const Ray& ray);

} // namespace raywise::contract
