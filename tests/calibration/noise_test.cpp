#include "measure/noise.h"

#include <gtest/gtest.h>

#include <unistd.h>

namespace raywise::calibration {
namespace {

TEST(ProcessorTime, IsReadFromTheSystemsText) {
    const double tick = 1.0 / static_cast<double>(::sysconf(_SC_CLK_TCK));
    const auto time = parse_processor_time("cpu  100 20 30 1000 50 4 6 7 0 0\ncpu0 1 1 1 1 1 1 1 1 0 0\n");
    ASSERT_TRUE(time);
    EXPECT_NEAR(time->busy, 160 * tick, 1e-9);
    EXPECT_NEAR(time->stolen, 7 * tick, 1e-9);
    EXPECT_NEAR(time->total, 1217 * tick, 1e-9);
    for (const char* text : {"", "cpu", "cpu 1 2 3", "intr 1 2 3 4 5 6 7 8 9"})
        EXPECT_FALSE(parse_processor_time(text)) << text;
}

TEST(Complaints, AreMadeAboutEachKindOfNoise) {
    EXPECT_TRUE(complaints({}).empty());
    EXPECT_TRUE(complaints({0.05, 0.05, 0.3, 0.01}).empty());
    EXPECT_EQ(complaints({0.5, 0.0, 0.0, 0.0}).size(), 1u);
    EXPECT_EQ(complaints({0.0, 0.5, 0.0, 0.0}).size(), 1u);
    EXPECT_EQ(complaints({0.0, 0.0, 0.9, 0.0}).size(), 1u);
    EXPECT_EQ(complaints({0.0, 0.0, 0.0, 0.5}).size(), 1u);
    EXPECT_EQ(complaints({0.5, 0.5, 0.9, 0.5}).size(), 4u);
    EXPECT_EQ(complaints({0.343, 0.0, 0.0, 0.0})[0], "repeated timings differ by 34 % (at most 10 %)");
}

TEST(NoiseWatch, JudgesTheMedianSpread) {
    NoiseWatch watch;
    const Noise noise = watch.judge({0.01, 0.02, 0.9});
    EXPECT_EQ(noise.spread, 0.02);
    EXPECT_GE(noise.drift, 0.0);
    EXPECT_GE(noise.others, 0.0);
    EXPECT_LE(noise.others, 1.0);
    EXPECT_GT(reference_ns(), 0.0);
}

} // namespace
} // namespace raywise::calibration
