// Every primitive in turn: no build, the judge of all other structures, and the best choice for very few rays.
#pragma once

#include "accel/visitors.h"

namespace raywise {

class LinearScan final : public TraversedAccel<LinearScan> {
public:
    explicit LinearScan(const BuildInput& input) : TraversedAccel(input.primitives) {}

    std::size_t bytes() const override { return sizeof *this; }

    template <class Visitor>
    void traverse(const PreparedRay&, Visitor& visitor) const {
        const std::uint32_t count = primitives().count();
        for (std::uint32_t i = 0; i < count; ++i) {
            if (visitor.visit(i)) return;
        }
    }
};

} // namespace raywise
