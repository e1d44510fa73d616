// A test once for each level of vector instructions that was compiled and that this processor has.
#pragma once

#include <hwy/targets.h>

#include <gtest/gtest.h>

#include <cstdint>

namespace raywise {

template <class Body>
void on_every_target(const Body& body) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        body();
    }
    hwy::SetSupportedTargetsForTest(0);
}

} // namespace raywise
