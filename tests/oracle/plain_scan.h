// Every primitive in turn, with the one exact test and nothing before it: what all structures are compared with, the library's own
// linear scan included.
#pragma once

#include "accel/visitors.h"

namespace raywise::oracle {

class PlainScan final : public TraversedAccel<PlainScan> {
public:
    explicit PlainScan(const BuildInput& input) : TraversedAccel(input.primitives) {}

    std::size_t bytes() const override { return sizeof *this; }

    template <class Visitor>
    void traverse(const PreparedRay&, Visitor& visitor) const {
        const std::uint32_t count = primitives().count();
        for (std::uint32_t i = 0; i < count; ++i) {
            if (visitor.visit(i)) return;
        }
    }
};

} // namespace raywise::oracle
