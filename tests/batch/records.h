// What the tests of batches share beside rays: options, and memory for answers.
#pragma once

#include "batch/batch.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace raywise::testing {

// Answers in the layout of the double precision outputs, one struct per ray.
struct Record {
    double t, uv[2], normal[3];
    std::uint32_t instance, geometry, primitive, filler;
};

inline HitArrays outputs(std::vector<Record>& records) {
    const auto field = [&](auto Record::*member, Scalar scalar) {
        return OutputArray{reinterpret_cast<std::byte*>(&(records.data()->*member)), sizeof(Record),
                           static_cast<std::ptrdiff_t>(size_of(scalar)), scalar};
    };
    return {field(&Record::t, Scalar::float64),       field(&Record::uv, Scalar::float64),
            field(&Record::normal, Scalar::float64),  field(&Record::instance, Scalar::uint32),
            field(&Record::geometry, Scalar::uint32), field(&Record::primitive, Scalar::uint32)};
}

inline BatchOptions options_of(unsigned threads, RayOrdering ordering = RayOrdering::where_it_pays,
                               BatchWorkspace* workspace = nullptr) {
    BatchOptions options;
    options.parallel = Parallel(threads);
    options.ordering = ordering;
    options.workspace = workspace;
    return options;
}

} // namespace raywise::testing
