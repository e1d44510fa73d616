// One number that is wrong, anywhere, among any count of numbers, at any address.
#include "geometry/array_checks.h"

#include "geometry/every_target.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace raywise {
namespace {

// The numbers in memory of their own, `offset` bytes from an aligned address.
template <class T>
class Packed {
public:
    Packed(const std::vector<T>& numbers, std::size_t offset)
        : bytes_(offset + numbers.size() * sizeof(T)), offset_(offset) {
        if (!numbers.empty()) std::memcpy(bytes_.data() + offset, numbers.data(), numbers.size() * sizeof(T));
    }
    const std::byte* data() const { return bytes_.data() + offset_; }

private:
    std::vector<std::byte> bytes_;
    std::size_t offset_;
};

const std::vector<std::size_t> counts = {0, 1, 2, 3, 4, 7, 8, 15, 16, 17, 31, 32, 33, 63, 64, 65, 100, 131};

// So many points, of numbers that come from all of `numbers` in turn.
template <class T>
std::vector<T> points_of(std::size_t count, const std::vector<T>& numbers) {
    std::vector<T> points(3 * count);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = numbers[(i + i / 3) % numbers.size()];
    return points;
}

template <class T>
bool bound(const std::vector<T>& points, std::size_t offset, Box& bounds) {
    return bound_points(Packed<T>(points, offset).data(), points.size() / 3, sizeof(T) == 8, bounds);
}

template <class T>
void expect_found(const std::vector<T>& right, const std::vector<T>& wrong, std::size_t offset) {
    for (const std::size_t count : counts) {
        std::vector<T> points = points_of(count, right);
        Box bounds;
        EXPECT_TRUE(bound(points, offset, bounds)) << count;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const T before = points[i];
            points[i] = wrong[(i + count) % wrong.size()];
            Box none;
            EXPECT_FALSE(bound(points, offset, none)) << "number " << i << " of " << count << " points";
            EXPECT_TRUE(none.empty()) << "bounds of what cannot be used";
            points[i] = before;
        }
    }
}

TEST(ArrayChecks, FindTheNumberThatIsNotWithinFloat32) {
    constexpr float f = std::numeric_limits<float>::max();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr double d = f;
    on_every_target([&] {
        for (const std::size_t offset : {0, 1, 4, 20}) {
            expect_found<float>({0.0f, -0.0f, 1.0f, f, -f, 1e-45f}, {infinity, -infinity, nan, -nan}, offset);
            expect_found<double>({0.0, -0.0, 1.0, d, -d, 5e-324},
                                 {double{infinity}, -double{infinity}, double{nan}, std::nextafter(d, 1e300),
                                  -std::nextafter(d, 1e300), 1e308, -1e308},
                                 offset);
        }
    });
}

// The bounds to either side of each axis are those of one number, anywhere.
template <class T>
void expect_bounds(std::size_t offset) {
    for (const std::size_t count : counts) {
        std::vector<T> points = points_of<T>(count, {1, 2, 3});
        for (std::size_t i = 0; i < points.size(); ++i) {
            const T before = points[i];
            for (const T number : {T(-7), T(9)}) {
                points[i] = number;
                Box expected;
                for (std::size_t k = 0; k < points.size(); k += 3)
                    expected.extend({points[k], points[k + 1], points[k + 2]});
                expected.extend(Vec3(2.0)); // what was there before stays
                Box bounds;
                bounds.extend(Vec3(2.0));
                ASSERT_TRUE(bound(points, offset, bounds));
                ASSERT_EQ(bounds.lower, expected.lower) << "number " << i << " of " << count << " points";
                ASSERT_EQ(bounds.upper, expected.upper) << "number " << i << " of " << count << " points";
            }
            points[i] = before;
        }
    }
}

TEST(ArrayChecks, BoundPointsAlongEachAxis) {
    on_every_target([] {
        for (const std::size_t offset : {0, 1, 4, 8, 20, 60}) {
            ASSERT_NO_FATAL_FAILURE(expect_bounds<float>(offset));
            ASSERT_NO_FATAL_FAILURE(expect_bounds<double>(offset));
        }
    });
}

TEST(ArrayChecks, FindTheIndexThatIsNotBelowTheLimit) {
    on_every_target([&] {
        for (const std::uint32_t limit : {1u, 7u, 0x7FFFFFFFu, 0x80000000u, 0x80000001u, 0xFFFFFFFFu}) {
            for (const std::size_t count : counts) {
                std::vector<std::uint32_t> numbers(count);
                for (std::size_t i = 0; i < count; ++i) numbers[i] = i % 3 == 0 ? 0 : limit - 1;
                EXPECT_TRUE(all_below(Packed<std::uint32_t>(numbers, 1).data(), count, limit)) << count;
                for (std::size_t i = 0; i < count; ++i) {
                    const std::uint32_t before = numbers[i];
                    numbers[i] = i % 2 == 0 ? limit : 0xFFFFFFFFu;
                    EXPECT_FALSE(all_below(Packed<std::uint32_t>(numbers, 1).data(), count, limit))
                        << i << " of " << count;
                    numbers[i] = before;
                }
            }
        }
        EXPECT_TRUE(all_below(nullptr, 0, 0));
        EXPECT_FALSE(all_below(Packed<std::uint32_t>({0}, 0).data(), 1, 0));
    });
}

} // namespace
} // namespace raywise
