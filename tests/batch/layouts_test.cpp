// Every way in which rays and answers may lie in the caller's memory.
#include "batch/batch.h"

#include "rays.h"
#include "records.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

namespace raywise {
namespace {

using namespace testing;

// Numbers of one kind in the caller's memory, in one of the ways it may lie there.
struct Layout {
    const char* name;
    Scalar scalar;
    std::ptrdiff_t stride; // in numbers; 0: one element for all
    std::ptrdiff_t step;   // from one component to the next, in numbers
    std::size_t skew;      // bytes in front
};

// More than there are rays, for components that lie apart.
constexpr std::ptrdiff_t apart = 5000;
constexpr Layout input_layouts[] = {{"packed float32", Scalar::float32, 3, 1, 0},
                                    {"rows of eight float32", Scalar::float32, 8, 1, 0},
                                    {"rows of six float32", Scalar::float32, 6, 1, 4},
                                    {"columns of float32", Scalar::float32, 1, apart, 0},
                                    {"backwards", Scalar::float32, -3, 1, 0},
                                    {"one for all", Scalar::float32, 0, 1, 0},
                                    {"unaligned", Scalar::float32, 3, 1, 1},
                                    {"packed float64", Scalar::float64, 3, 1, 0},
                                    {"columns of float64", Scalar::float64, 1, apart, 3}};

class Column {
public:
    Column(const Layout& layout, std::size_t count, Scalar scalar)
        : layout_(layout), scalar_(scalar), bytes_(8 * 8 * apart + 64, std::byte{0xEE}) {
        start_ = bytes_.data() + layout.skew;
        if (layout.stride < 0) start_ += (count - 1) * -layout.stride * size();
    }
    std::ptrdiff_t stride() const { return layout_.stride * size(); }
    std::ptrdiff_t step() const { return layout_.step * size(); }
    std::byte* at(std::size_t i, int component) {
        return start_ + static_cast<std::ptrdiff_t>(i) * stride() + component * step();
    }
    void put(std::size_t i, int component, float value) {
        const double wide = value;
        std::memcpy(at(i, component), scalar_ == Scalar::float32 ? static_cast<const void*>(&value) : &wide, size());
    }
    StridedArray input() { return {start_, stride(), step(), scalar_}; }
    OutputArray output() { return {start_, stride(), step(), scalar_}; }

private:
    std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(size_of(scalar_)); }
    const Layout& layout_;
    const Scalar scalar_;
    std::vector<std::byte> bytes_;
    std::byte* start_;
};

std::shared_ptr<Scene> scene_of_two_meshes() {
    auto two = std::make_shared<Scene>(std::make_shared<const Profile>(generic_profile()));
    const Soup one = make_soup(300), other = make_soup(200, 2);
    two->add_triangles(one.arrays(), true, false);
    two->add_triangles(other.arrays(), true, false);
    two->set_structure(Structure::bvh);
    Progress progress;
    two->commit(Parallel(1), progress);
    return two;
}

// Every way in which origins, directions and intervals may lie, by themselves and together.
TEST(BatchLayouts, ReadsEveryLayoutAsSingleRays) {
    constexpr std::size_t count = 4200;
    std::vector<RayF> chords;
    for (const Ray& chord : make_chords(count))
        chords.push_back({glm::vec3(chord.origin), 0.1f, glm::vec3(chord.direction), 1.5f});
    const auto two = scene_of_two_meshes();
    for (const Layout& of_origin : input_layouts) {
        for (const Layout& of_direction : input_layouts) {
            for (const Layout* of_interval :
                 {static_cast<const Layout*>(nullptr), &input_layouts[0], &input_layouts[8]}) {
                if (of_origin.stride == 0 && of_direction.stride == 0) continue; // all rays alike
                SCOPED_TRACE(std::string(of_origin.name) + ", " + of_direction.name);
                std::vector<RayF> rays = chords;
                Column origin(of_origin, count, of_origin.scalar);
                Column direction(of_direction, count, of_direction.scalar);
                const Layout& interval = of_interval != nullptr ? *of_interval : input_layouts[0];
                Column tmin(interval, count, interval.scalar), tmax(interval, count, interval.scalar);
                for (std::size_t i = 0; i < count; ++i) {
                    if (of_origin.stride == 0) rays[i].origin = chords[0].origin;
                    if (of_direction.stride == 0) rays[i].direction = chords[0].direction;
                    if (of_interval == nullptr)
                        rays[i].tmin = 0.0f, rays[i].tmax = std::numeric_limits<float>::infinity();
                    for (int axis = 0; axis < 3; ++axis) {
                        origin.put(i, axis, rays[i].origin[axis]);
                        direction.put(i, axis, rays[i].direction[axis]);
                    }
                    tmin.put(i, 0, rays[i].tmin);
                    tmax.put(i, 0, rays[i].tmax);
                }
                RayArrays arrays{count, origin.input(), direction.input(), {}, {}, {}};
                if (of_interval != nullptr) {
                    arrays.tmin = tmin.input();
                    arrays.tmax = tmax.input();
                }
                for (const RayOrdering ordering : {RayOrdering::always, RayOrdering::never}) {
                    std::vector<Record> records(count);
                    std::vector<std::uint8_t> occluded(count);
                    intersect_batch(two->tracer(), arrays, outputs(records), options_of(1, ordering));
                    occluded_batch(two->tracer(), arrays,
                                   {reinterpret_cast<std::byte*>(occluded.data()), 1, 1, Scalar::uint8},
                                   options_of(1, ordering));
                    for (std::size_t i = 0; i < count; ++i) {
                        const Record& r = records[i];
                        const Hit expected = two->tracer().closest(widened(rays[i]));
                        ASSERT_TRUE(same_bits(expected, {r.t, r.uv[0], r.uv[1], r.instance, r.geometry, r.primitive}))
                            << i;
                        ASSERT_EQ(occluded[i], expected.is_hit() ? 1 : 0) << i;
                    }
                }
            }
        }
    }
}

TEST(BatchLayouts, WritesEveryLayoutAndOnlyWhatIsWanted) {
    constexpr std::size_t count = 4200;
    const std::vector<Ray> rays = make_chords(count);
    const auto two = scene_of_two_meshes();
    std::vector<Hit> expected;
    for (const Ray& ray : rays) expected.push_back(two->tracer().closest(ray));
    constexpr Layout output_layouts[] = {{"packed", Scalar::float32, 3, 1, 0},
                                         {"rows", Scalar::float32, 7, 2, 1},
                                         {"columns", Scalar::float32, 1, apart, 0},
                                         {"backwards", Scalar::float32, -3, 1, 2}};
    const auto is_number = [](std::byte* at, Scalar scalar, double value) {
        const auto narrow = static_cast<float>(value);
        return std::memcmp(at, scalar == Scalar::float32 ? static_cast<const void*>(&narrow) : &value,
                           size_of(scalar)) == 0;
    };
    const auto is_id = [](std::byte* at, Scalar scalar, std::uint32_t id) {
        const std::uint64_t wide = id == invalid_id ? ~std::uint64_t{0} : id;
        return std::memcmp(at, &wide, size_of(scalar)) == 0;
    };
    for (const Layout& layout : output_layouts) {
        for (const bool wide : {false, true}) {
            for (unsigned wanted = 0; wanted < 64; wanted += wanted < 3 ? 1 : 5) {
                SCOPED_TRACE(std::string(layout.name) + ", fields " + std::to_string(wanted));
                const Scalar numbers = wide ? Scalar::float64 : Scalar::float32;
                const Scalar ids = wide ? Scalar::uint64 : Scalar::uint32;
                Column t(layout, count, numbers), uv(layout, count, numbers), normal(layout, count, numbers);
                Column instance(layout, count, ids), geometry(layout, count, ids), primitive(layout, count, ids);
                HitArrays hits;
                const auto want = [&](unsigned bit, Column& column, OutputArray HitArrays::*field) {
                    if ((wanted >> bit & 1u) != 0) hits.*field = column.output();
                };
                want(0, t, &HitArrays::t);
                want(1, uv, &HitArrays::uv);
                want(2, normal, &HitArrays::normal);
                want(3, instance, &HitArrays::instance);
                want(4, geometry, &HitArrays::geometry);
                want(5, primitive, &HitArrays::primitive);
                intersect_batch(two->tracer(), arrays_of(rays), hits,
                                options_of(1, wide ? RayOrdering::always : RayOrdering::never));
                for (std::size_t i = 0; i < count; ++i) {
                    const Hit& hit = expected[i];
                    const Vec3 n =
                        hit.is_hit()
                            ? unit_normal(two->tracer().primitives().meshes()[hit.geometry]->corners(hit.primitive))
                            : Vec3(0.0);
                    if (hits.t.wanted()) {
                        ASSERT_TRUE(is_number(t.at(i, 0), numbers, hit.t)) << i;
                    }
                    if (hits.uv.wanted()) {
                        ASSERT_TRUE(is_number(uv.at(i, 0), numbers, hit.u) && is_number(uv.at(i, 1), numbers, hit.v))
                            << i;
                        for (int axis = 0; axis < 3 && hits.normal.wanted(); ++axis)
                            ASSERT_TRUE(is_number(normal.at(i, axis), numbers, n[axis])) << i;
                    }
                    if (hits.instance.wanted()) {
                        ASSERT_TRUE(is_id(instance.at(i, 0), ids, invalid_id)) << i;
                    }
                    if (hits.geometry.wanted()) {
                        ASSERT_TRUE(is_id(geometry.at(i, 0), ids, hit.geometry)) << i;
                    }
                    if (hits.primitive.wanted()) {
                        ASSERT_TRUE(is_id(primitive.at(i, 0), ids, hit.primitive)) << i;
                    }
                }
            }
        }
    }
}

} // namespace
} // namespace raywise
