// Every primitive in turn, with the test for one triangle and nothing before it: what all structures are compared with, the library's own
// linear scan included.
#pragma once

#include "accel/traversed_accel.h"

namespace raywise::oracle {

class PlainScan final : public TraversedAccel<PlainScan> {
public:
    explicit PlainScan(const BuildInput& input) : TraversedAccel(input.primitives) {}

    std::size_t bytes() const override { return sizeof *this; }

    template <class Collector>
    void traverse(const ExactRay& ray, Collector& collector) const {
        const std::uint32_t count = primitives().count();
        for (std::uint32_t i = 0; i < count; ++i) {
            PrimitiveHit hit;
            if (primitives().test(ray, i, hit) && collector.collect(hit)) return;
        }
    }
};

} // namespace raywise::oracle
