#include "contract/expectation.h"

#include "contract/numbers.h"

#include <algorithm>

namespace raywise::contract {

const std::vector<ExpectationKind>& expectation_kinds() {
    using Takes = ExpectationKind::Takes;
    static const std::vector<ExpectationKind> kinds = {
        // kind, word, takes, needs all hits, for sweeps
        {Expected::hit, "hit", Takes::nothing, false, true},
        {Expected::miss, "miss", Takes::nothing, false, true},
        {Expected::t, "t", Takes::one_number, false, true},
        {Expected::primitive, "primitive", Takes::ids, false, true},
        {Expected::lowest, "lowest", Takes::one_id, false, true},
        {Expected::count, "count", Takes::count, true, true},
        {Expected::even, "even", Takes::nothing, true, true},
        {Expected::odd, "odd", Takes::nothing, true, true},
        {Expected::inside, "inside", Takes::nothing, true, true},
        {Expected::outside, "outside", Takes::nothing, true, true},
        {Expected::all_t, "all-t", Takes::numbers, true, false},
        {Expected::exact, "exact", Takes::nothing, false, true},
        {Expected::plane, "plane", Takes::nothing, false, true},
        {Expected::batch, "same-as-batch", Takes::nothing, false, true},
        {Expected::repeatable, "repeatable", Takes::count, false, true},
    };
    return kinds;
}

const ExpectationKind& describe(Expected kind) {
    const auto& kinds = expectation_kinds();
    return *std::find_if(kinds.begin(), kinds.end(), [kind](const ExpectationKind& row) { return row.kind == kind; });
}

std::string text_of(const Expectation& expectation) {
    std::string text = describe(expectation.kind).word;
    for (const double number : expectation.numbers) text += " " + text_of(number);
    for (const PrimitiveId& id : expectation.ids) {
        text += " ";
        if (id.geometry != 0) text += std::to_string(id.geometry) + ":";
        text += std::to_string(id.primitive);
    }
    return text;
}

} // namespace raywise::contract
