#include "base/progress.h"

#include <gtest/gtest.h>

namespace raywise {
namespace {

TEST(Progress, WithoutACallbackNeverStops) {
    Progress progress;
    EXPECT_NO_THROW(progress.report(0.5, "building"));
}

TEST(Progress, ThrowsOnceAndForAllWhenAskedToStop) {
    int calls = 0;
    Progress progress([&](double, const char*) { return ++calls == 2; });
    EXPECT_NO_THROW(progress.report(0.1, "building"));
    for (int i = 0; i < 3; ++i) {
        try {
            progress.report(0.2, "building");
            FAIL() << "not cancelled";
        } catch (const Error& error) {
            EXPECT_EQ(error.status(), Status::ERROR_CANCELLED);
        }
    }
    EXPECT_EQ(calls, 2);
}

} // namespace
} // namespace raywise
