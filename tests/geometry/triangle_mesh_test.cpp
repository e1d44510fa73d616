// Meshes in the caller's memory: any layout, nothing invalid gets through, and every fault is named.
#include "geometry/triangle_mesh.h"

#include "base/error.h"
#include "geometry/laid_out_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

namespace raywise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Arrays {
    std::vector<double> vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};

    TriangleArrays describe() const {
        TriangleArrays arrays;
        arrays.vertices = {reinterpret_cast<const std::byte*>(vertices.data()), 24, 8, Scalar::float64};
        arrays.vertex_count = vertices.size() / 3;
        arrays.indices = {reinterpret_cast<const std::byte*>(indices.data()), 12, 4, Scalar::uint32};
        arrays.triangle_count = indices.size() / 3;
        return arrays;
    }
};

void expect_error(const TriangleArrays& arrays, Status status, const std::string& message) {
    try {
        const TriangleMesh mesh(arrays, true, false);
        FAIL() << "no error: " << message;
    } catch (const Error& error) {
        EXPECT_EQ(static_cast<int>(error.status()), static_cast<int>(status)) << error.what();
        EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
}

TEST(TriangleMesh, ReadsPackedArrays) {
    const Arrays data;
    for (const bool copy : {false, true}) {
        const TriangleMesh mesh(data.describe(), copy, false);
        EXPECT_EQ(mesh.triangle_count(), 2u);
        EXPECT_EQ(mesh.corners(1), (Corners{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}));
        EXPECT_EQ(mesh.bytes() > 0, copy);
    }
}

TEST(TriangleMesh, ReadsAnyStrideAndType) {
    // float32 structure of arrays, backwards, and unaligned 64 bit indices between other bytes.
    const float coordinates[3][4] = {{0, 0, 1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}}; // x, y, z of vertices 3 to 0
    std::vector<std::byte> bytes(200);
    for (std::size_t triangle = 0; triangle < 2; ++triangle) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint64_t index = std::vector<std::uint64_t>{0, 1, 2, 0, 2, 3}[3 * triangle + corner];
            std::memcpy(bytes.data() + 3 + 37 * triangle + 11 * corner, &index, sizeof index);
        }
    }
    TriangleArrays arrays;
    arrays.vertices = {reinterpret_cast<const std::byte*>(&coordinates[0][3]), -4, 16, Scalar::float32};
    arrays.vertex_count = 4;
    arrays.indices = {bytes.data() + 3, 37, 11, Scalar::uint64};
    arrays.triangle_count = 2;
    for (const bool copy : {false, true}) {
        const TriangleMesh mesh(arrays, copy, false);
        EXPECT_EQ(mesh.corners(0), (Corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}));
        EXPECT_EQ(mesh.corners(1), (Corners{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}));
    }
}

TEST(TriangleMesh, TakesVerticesInThreesWithoutIndices) {
    Arrays data;
    data.vertices.resize(18, 0.5);
    TriangleArrays arrays = data.describe();
    arrays.indices = {};
    const TriangleMesh mesh(arrays, true, false);
    EXPECT_EQ(mesh.corners(0)[1], Vec3(1, 0, 0));
    EXPECT_EQ(mesh.corners(1)[0], Vec3(0, 0, 1));
    arrays.vertex_count = 5;
    expect_error(arrays, Status::ERROR_INVALID_ARGUMENT, "vertex_count is 5 and triangle_count 2");
}

TEST(TriangleMesh, CopiesWhenAsked) {
    Arrays data;
    const TriangleMesh copied(data.describe(), true, false);
    const TriangleMesh shared(data.describe(), false, false);
    data.vertices[3] = 7.0;
    EXPECT_EQ(copied.corners(0)[1].x, 1.0);
    EXPECT_EQ(shared.corners(0)[1].x, 7.0);
}

TEST(TriangleMesh, MayBeEmpty) {
    const TriangleMesh none(TriangleArrays{}, true, false);
    EXPECT_EQ(none.triangle_count(), 0u);
    Arrays data;
    data.indices.clear();
    EXPECT_EQ(TriangleMesh(data.describe(), true, false).triangle_count(), 0u);
}

TEST(TriangleMesh, NamesACoordinateThatIsNotFinite) {
    for (const double bad : {std::nan(""), infinity, -infinity}) {
        Arrays data;
        data.vertices[7] = bad;
        expect_error(data.describe(), Status::ERROR_NOT_FINITE, "vertex 2: coordinate y is ");
    }
}

TEST(TriangleMesh, NamesACoordinateBeyondFloat32) {
    Arrays data;
    data.vertices[11] = 3.5e38;
    expect_error(data.describe(), Status::ERROR_COORDINATE_RANGE, "vertex 3: coordinate z");
    data.vertices[11] = -std::nextafter(static_cast<double>(std::numeric_limits<float>::max()), infinity);
    expect_error(data.describe(), Status::ERROR_COORDINATE_RANGE, "vertex 3: coordinate z");
    data.vertices[11] = std::numeric_limits<float>::max();
    EXPECT_NO_THROW(TriangleMesh(data.describe(), true, false));
}

TEST(TriangleMesh, NamesAnIndexOutOfRange) {
    Arrays data;
    data.indices[4] = 9000;
    expect_error(data.describe(), Status::ERROR_INDEX_OUT_OF_RANGE,
                 "triangle 1: index 9000 is out of range, the mesh has 4 vertices");
    data.indices[4] = 4;
    expect_error(data.describe(), Status::ERROR_INDEX_OUT_OF_RANGE, "index 4");
}

TEST(TriangleMesh, NamesCountsBeyondTheIds) {
    Arrays data;
    TriangleArrays arrays = data.describe();
    arrays.vertex_count = std::uint64_t{1} << 32;
    expect_error(arrays, Status::ERROR_TOO_MANY, "vertex_count");
    arrays = data.describe();
    arrays.triangle_count = 0xFFFFFFFF;
    expect_error(arrays, Status::ERROR_TOO_MANY, "triangle_count");
    arrays.triangle_count = ~std::uint64_t{0};
    expect_error(arrays, Status::ERROR_TOO_MANY, "triangle_count");
}

TEST(TriangleMesh, SkipsInvalidTrianglesWhenAsked) {
    Arrays data;
    data.indices = {0, 1, 2, 0, 2, 3, 0, 1, 4, 1, 2, 0xFFFFFFFF, 2, 1, 0};
    data.vertices[10] = std::nan("");
    for (const bool copy : {false, true}) {
        const TriangleMesh mesh(data.describe(), copy, true);
        EXPECT_EQ(mesh.triangle_count(), 5u);
        EXPECT_EQ(mesh.invalid_count(), 3u);
        EXPECT_TRUE(mesh.is_valid(0));
        EXPECT_FALSE(mesh.is_valid(1)) << "its vertex is NaN";
        EXPECT_FALSE(mesh.is_valid(2)) << "its index is out of range";
        EXPECT_FALSE(mesh.is_valid(3));
        EXPECT_TRUE(mesh.is_valid(4));
    }
}

TEST(TriangleMesh, KeepsWideIndicesApartWhenTheyAreCut) {
    // 2^32 cut to 32 bits would be vertex 0.
    const Arrays data;
    const std::vector<std::uint64_t> indices = {std::uint64_t{1} << 32, 1, 2};
    TriangleArrays arrays = data.describe();
    arrays.indices = {reinterpret_cast<const std::byte*>(indices.data()), 24, 8, Scalar::uint64};
    arrays.triangle_count = 1;
    expect_error(arrays, Status::ERROR_INDEX_OUT_OF_RANGE, "index 4294967296");
    EXPECT_FALSE(TriangleMesh(arrays, true, true).is_valid(0));
}

TEST(TriangleMesh, KeepsTheIndicesOfTheMeshItWas) {
    Arrays data;
    TriangleArrays moved = data.describe();
    moved.indices = {};
    for (const bool was_copied : {false, true}) {
        for (const bool copy : {false, true}) {
            auto before = std::make_unique<TriangleMesh>(data.describe(), was_copied, false);
            const TriangleMesh mesh(*before, moved, copy, false);
            const TriangleMesh third(mesh, moved, copy, false);
            const std::size_t bytes = before->bytes();
            before.reset();
            EXPECT_EQ(third.corners(1), (Corners{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}));
            if (was_copied && copy) {
                EXPECT_EQ(third.bytes(), bytes);
            }
            // Indices that are read in place stay so only where nothing is copied.
            EXPECT_EQ(mesh.arrays().indices.data == data.describe().indices.data, !was_copied && !copy);
        }
    }
    moved.vertex_count -= 1;
    const TriangleMesh before(data.describe(), true, false);
    try {
        const TriangleMesh mesh(before, moved, true, false, "meshes[4].");
        FAIL() << "there are fewer vertices";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("meshes[4].vertex_count: it is 3"), std::string::npos) << error.what();
    }
}

TEST(TriangleMesh, IndicesThatWereInvalidStayInvalidWhenTheyAreKept) {
    const Arrays data;
    // In the lower half of the second one is a valid index.
    const std::uint64_t wide[] = {0, 1, 4, 0, (std::uint64_t{1} << 32) + 1, 2, 0, 1, 2};
    TriangleArrays arrays = data.describe();
    arrays.indices = {reinterpret_cast<const std::byte*>(wide), 24, 8, Scalar::uint64};
    arrays.triangle_count = 3;
    const TriangleMesh before(arrays, true, true);
    arrays.indices = {};
    for (const bool copy : {false, true}) {
        const TriangleMesh mesh(before, arrays, copy, true);
        EXPECT_EQ(mesh.invalid_count(), 2u);
        EXPECT_FALSE(mesh.is_valid(0));
        EXPECT_FALSE(mesh.is_valid(1));
        EXPECT_TRUE(mesh.is_valid(2));
        EXPECT_THROW(TriangleMesh(before, arrays, copy, false), Error);
    }
}

// Enough for whole registers and for what is left behind them; each place in turn.
TEST(TriangleMesh, NamesWhatIsWrongAtAnyPlace) {
    constexpr std::size_t vertex_count = 83;
    std::vector<float> vertices(3 * vertex_count);
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = static_cast<float>(i % 7);
    std::vector<std::uint32_t> indices(3 * 40);
    for (std::size_t i = 0; i < indices.size(); ++i)
        indices[i] = static_cast<std::uint32_t>(i * 5 % (vertex_count - 1));
    TriangleArrays arrays;
    arrays.vertices = {reinterpret_cast<const std::byte*>(vertices.data()), 12, 4, Scalar::float32};
    arrays.vertex_count = vertex_count;
    arrays.indices = {reinterpret_cast<const std::byte*>(indices.data()), 12, 4, Scalar::uint32};
    arrays.triangle_count = indices.size() / 3;
    ASSERT_NO_THROW(TriangleMesh(arrays, false, false));
    for (std::size_t i = 0; i < vertices.size(); ++i) { // the last vertex is one that no triangle has
        const float before = vertices[i];
        const std::string name = "vertex " + std::to_string(i / 3) + ": coordinate " + "xyz"[i % 3];
        vertices[i] = static_cast<float>(std::nan(""));
        expect_error(arrays, Status::ERROR_NOT_FINITE, name + " is NaN");
        vertices[i] = static_cast<float>(i % 2 == 0 ? infinity : -infinity);
        expect_error(arrays, Status::ERROR_NOT_FINITE, name + " is infinite");
        vertices[i] = before;
    }
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const std::uint32_t before = indices[i];
        for (const std::uint32_t wrong : {std::uint32_t{vertex_count}, 0xFFFFFFFFu}) {
            indices[i] = wrong;
            expect_error(arrays, Status::ERROR_INDEX_OUT_OF_RANGE,
                         "triangle " + std::to_string(i / 3) + ": index " + std::to_string(wrong) +
                             " is out of range, the mesh has 83 vertices");
        }
        indices[i] = before;
    }
    // The first of several is named.
    vertices[30] = vertices[200] = static_cast<float>(infinity);
    indices[0] = vertex_count;
    expect_error(arrays, Status::ERROR_NOT_FINITE, "vertex 10: coordinate x");
}

TEST(TriangleMesh, BoundsAllItsVertices) {
    for (const std::size_t count : {1, 4, 63, 64, 65, 200}) {
        std::vector<Vec3> vertices;
        Box expected;
        for (std::size_t i = 0; i < count; ++i) {
            const auto x = static_cast<double>(i * 37 % 101);
            vertices.emplace_back(x - 50.0, 3.0 - x, static_cast<double>(i * 53 % 97));
            expected.extend(vertices.back());
        }
        for (const Layout& layout : every_layout()) {
            if (!layout.indexed) continue; // only what triangles have is in the arrays
            const LaidOutMesh laid_out(vertices, {0, 0, 0}, layout);
            const auto mesh = laid_out.shared();
            EXPECT_EQ(mesh->vertex_bounds().lower, expected.lower) << layout.name << ", " << count;
            EXPECT_EQ(mesh->vertex_bounds().upper, expected.upper) << layout.name << ", " << count;
            vertices[count / 2].y = infinity;
            const LaidOutMesh bad(vertices, {0, 0, 0}, layout);
            EXPECT_TRUE(bad.shared(true)->vertex_bounds().empty()) << layout.name << ", " << count;
            vertices[count / 2].y = 3.0 - static_cast<double>(count / 2 * 37 % 101);
        }
    }
}

} // namespace
} // namespace raywise
