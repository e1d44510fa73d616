// Coordinates as they are written: float64 where float32 would change one, float32 otherwise.
#include "io/mesh_files.h"

namespace raywise {
namespace {

class Precision : public MeshFiles {
protected:
    // A triangle with a corner at (x, 0, 0), as each format writes it. PLY in text, of the given type.
    LoadedMesh obj(const std::string& x) { return load("a.obj", "v " + x + " 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"); }
    LoadedMesh off(const std::string& x) { return load("a.off", "OFF\n3 1 0\n" + x + " 0 0\n0 1 0\n0 0 1\n3 0 1 2\n"); }
    LoadedMesh stl(const std::string& x) {
        return load("a.stl", "solid\nfacet normal 0 0 0\nouter loop\nvertex " + x +
                                 " 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid\n");
    }
    LoadedMesh ply(const std::string& type, const std::string& x) {
        return load("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty " + type + " x\nproperty " + type +
                                 " y\nproperty " + type +
                                 " z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" + x +
                                 " 0 0\n0 1 0\n0 0 1\n3 0 1 2\n");
    }
    std::vector<LoadedMesh> in_text(const std::string& x) {
        return {obj(x), off(x), stl(x), ply("double", x), ply("float64", x)};
    }
};

TEST_F(Precision, OfTextIsFloat32WhereThatHoldsEveryNumber) {
    for (const auto& [word, x] :
         std::vector<std::pair<std::string, float>>{{"0.5", 0.5f},
                                                    {"100.25", 100.25f},
                                                    {"-16777216", -16777216.0f},
                                                    {"+1.5e1", 15.0f},
                                                    {"0.100000001490116119384765625", 0.1f},
                                                    {"340282346638528859811704183484516925440", 3.402823466e38f},
                                                    {"0.30000001192092895", 0.3f},
                                                    {"1e-400", 0.0f},
                                                    {"-0.0", -0.0f}}) {
        SCOPED_TRACE(word);
        for (const LoadedMesh& mesh : in_text(word)) EXPECT_EQ(floats(mesh).at(0), x);
    }
}

TEST_F(Precision, OfTextIsFloat64WhereFloat32WouldChangeANumber) {
    for (const auto& [word, x] :
         std::vector<std::pair<std::string, double>>{{"0.1", 0.1},
                                                     {"6378137.123456789", 6378137.123456789},
                                                     {"500000.1", 500000.1},
                                                     {"16777217", 16777217.0},
                                                     {"1e39", 1e39},
                                                     {"1e-46", 1e-46},
                                                     {"0.3000000119", 0.3000000119},
                                                     {"1.7976931348623157e308", 1.7976931348623157e308},
                                                     {"5e-324", 5e-324}}) {
        SCOPED_TRACE(word);
        for (const LoadedMesh& mesh : in_text(word)) {
            const std::vector<double> vertices = doubles(mesh);
            EXPECT_EQ(vertices.at(0), x);
            EXPECT_EQ(std::vector<double>(vertices.begin() + 1, vertices.end()),
                      (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1}));
        }
    }
}

TEST_F(Precision, KeepsASquareOfTenCentimetresAtUtmCoordinates) {
    const LoadedMesh mesh = load("a.obj",
                                 "v 500000.1 5183526.3 100.25\nv 500000.2 5183526.3 100.25\n"
                                 "v 500000.2 5183526.4 100.25\nv 500000.1 5183526.4 100.25\nf 1 2 3 4\n");
    EXPECT_EQ(doubles(mesh), (std::vector<double>{500000.1, 5183526.3, 100.25, 500000.2, 5183526.3, 100.25, 500000.2,
                                                  5183526.4, 100.25, 500000.1, 5183526.4, 100.25}));
    EXPECT_EQ(mesh.triangle_count(), 2u);
}

TEST_F(Precision, OfPlyIsThatOfItsTypes) {
    // Text of float32 numbers is what a binary file of them would be.
    for (const char* type : {"float", "float32"}) {
        for (const auto& [word, x] : std::vector<std::pair<std::string, float>>{{"0.1", 0.1f},
                                                                                {"1e-45", 1e-45f},
                                                                                {"3.4028234e38", 3.4028234e38f},
                                                                                {"-0.3333333333333", -0.3333333333333f},
                                                                                {"1e-60", 0.0f},
                                                                                {"123456789", 123456789.0f},
                                                                                {"16777217", 16777216.0f}}) {
            SCOPED_TRACE(word);
            EXPECT_EQ(floats(ply(type, word)).at(0), x);
        }
    }
    for (const char* type : {"char", "int8", "uchar", "uint8", "short", "int16", "ushort", "uint16", "int", "int32",
                             "uint", "uint32", "int64", "uint64"}) {
        EXPECT_EQ(floats(ply(type, "100")).at(0), 100.0f) << type;
    }
    EXPECT_EQ(doubles(ply("int", "16777217")).at(0), 16777217.0);
    EXPECT_EQ(doubles(ply("int64", "9007199254740991")).at(0), 9007199254740991.0);
    const std::string too_large =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement "
        "face 1\nproperty list uchar int vertex_indices\nend_header\n1e39 0 0\n3 0 0 0\n";
    expect_error("a.ply", too_large, Status::ERROR_NOT_FINITE, "vertex 0: \"1e39\" is no finite float32 (line 10)");
}

TEST_F(Precision, OfBinaryPlyIsFloat64WhereADoubleIsNoFloat) {
    for (const bool big_endian : {false, true}) {
        const std::string bytes = binary_ply(big_endian, "double", "uchar", "int");
        EXPECT_EQ(floats(load("a.ply", bytes)), square_vertices);
        std::string number;
        put(number, 6378137.123456789, big_endian);
        std::string changed = bytes;
        changed.replace(changed.find("end_header\n") + 11, 8, number);
        EXPECT_EQ(doubles(load("a.ply", changed)).at(0), 6378137.123456789);
    }
}

TEST_F(Precision, OfBinaryPlyHoldsIntegersOfEveryType) {
    for (const bool big_endian : {false, true}) {
        const auto file = [&](const char* type, auto one, auto other) {
            std::string bytes =
                std::string("ply\nformat ") + (big_endian ? "binary_big_endian" : "binary_little_endian") +
                " 1.0\nelement vertex 3\nproperty int64 id\nproperty " + type + " x\nproperty " + type +
                " y\nproperty " + type + " z\nelement face 1\nproperty list uint64 uint64 vertex_indices\nend_header\n";
            for (std::uint64_t i = 0; i < 3; ++i) {
                put(bytes, std::int64_t{-1}, big_endian);
                put(bytes, one, big_endian);
                put(bytes, other, big_endian);
                put(bytes, one, big_endian);
            }
            put(bytes, std::uint64_t{3}, big_endian);
            for (std::uint64_t i = 0; i < 3; ++i) put(bytes, i, big_endian);
            return bytes;
        };
        const std::vector<float> signs = {-1, 2, -1, -1, 2, -1, -1, 2, -1};
        EXPECT_EQ(floats(load("a.ply", file("char", std::int8_t{-1}, std::int8_t{2}))), signs);
        EXPECT_EQ(floats(load("a.ply", file("short", std::int16_t{-1}, std::int16_t{2}))), signs);
        EXPECT_EQ(floats(load("a.ply", file("int", std::int32_t{-1}, std::int32_t{2}))), signs);
        EXPECT_EQ(floats(load("a.ply", file("int64", std::int64_t{-1}, std::int64_t{2}))), signs);
        const std::vector<float> large = {255, 2, 255, 255, 2, 255, 255, 2, 255};
        EXPECT_EQ(floats(load("a.ply", file("uchar", std::uint8_t{255}, std::uint8_t{2}))), large);
        EXPECT_EQ(floats(load("a.ply", file("ushort", std::uint16_t{255}, std::uint16_t{2}))), large);
        EXPECT_EQ(floats(load("a.ply", file("uint64", std::uint64_t{255}, std::uint64_t{2}))), large);
        EXPECT_EQ(doubles(load("a.ply", file("uint", std::uint32_t{4294967295u}, std::uint32_t{2}))).at(0),
                  4294967295.0);
    }
}

TEST_F(Precision, OfBinaryStlIsFloat32) {
    EXPECT_EQ(floats(load("a.stl", binary_stl({{0.1f, 0, 0, 1, 0, 0, 0, 1, 0}}))).at(0), 0.1f);
}

// What is out of a double's range is zero or infinite, however it is written.
TEST_F(Precision, TellsTooLargeFromTooSmall) {
    const std::string zeros(400, '0');
    for (const std::string& word :
         std::vector<std::string>{"0." + zeros + "1", "0" + zeros + "." + zeros + "1", "1e-99999999999999999999",
                                  "1" + zeros + "e-900", "-0.0e999"}) {
        EXPECT_EQ(floats(obj(word)).at(0), 0.0f) << word;
    }
    EXPECT_EQ(doubles(obj("1" + zeros + "e-300")).at(0), 1e100);
    EXPECT_EQ(floats(obj("0." + zeros + "1e+402")).at(0), 10.0f);
    for (const std::string& word : std::vector<std::string>{"1" + zeros, "-1" + zeros + ".5", "1e99999999999999999999",
                                                            "1" + zeros + "e-10", "0.0001e999"}) {
        expect_error("a.obj", "v 0 0 " + word + "\nv 0 1 0\nv 0 0 1\nf 1 2 3\n", Status::ERROR_NOT_FINITE,
                     "vertex 0: ");
    }
}

} // namespace
} // namespace raywise
