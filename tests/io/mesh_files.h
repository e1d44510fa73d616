// What the tests of mesh files share: a folder to write them to, files of a square, and what has to come of them.
#pragma once

#include "io/mesh_file.h"

#include "base/error.h"
#include "io/temporary_files.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <variant>
#include <vector>

namespace raywise {

using Indices = std::vector<std::uint32_t>;

// The coordinates of a mesh that has to be of float32; none if it is not.
inline std::vector<float> floats(const LoadedMesh& mesh) {
    EXPECT_FALSE(mesh.is_float64());
    return mesh.is_float64() ? std::vector<float>() : std::get<std::vector<float>>(mesh.vertices);
}

// The same of float64.
inline std::vector<double> doubles(const LoadedMesh& mesh) {
    EXPECT_TRUE(mesh.is_float64());
    return mesh.is_float64() ? std::get<std::vector<double>>(mesh.vertices) : std::vector<double>();
}

class MeshFiles : public ::testing::Test {
protected:
    LoadedMesh load(const std::string& name, const std::string& content) {
        return load_mesh(files_.write(name, content));
    }

    // The status and message of a file that cannot be loaded.
    void expect_error(const std::string& name, const std::string& content, Status status,
                      const std::string& part_of_message) {
        const std::filesystem::path path = files_.write(name, content);
        try {
            load_mesh(path);
            FAIL() << name << " was loaded: " << content.substr(0, 200);
        } catch (const Error& error) {
            EXPECT_EQ(static_cast<int>(error.status()), static_cast<int>(status)) << error.what() << "\n"
                                                                                  << content.substr(0, 200);
            EXPECT_NE(std::string(error.what()).find(part_of_message), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
    }

    TemporaryFiles files_;
};

template <class T>
void put(std::string& bytes, T value, bool big_endian = false) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    for (std::size_t i = 0; i < sizeof value; ++i) bytes += raw[big_endian ? sizeof value - 1 - i : i];
}

inline const std::string square_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n";
inline const std::string square_off = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 3\n";
inline const std::string square_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 3\n";
inline const std::string facet_stl =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0.5\nendloop\nendfacet\nendsolid "
    "a\n";
inline const std::vector<float> square_vertices = {0, 0, 0, 1, 0, 0, 1, 1, 0.5f, 0, 1, 0};

inline void expect_square(const LoadedMesh& mesh) {
    EXPECT_EQ(floats(mesh), square_vertices);
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(mesh.face_of_triangle, (Indices{0, 0}));
    EXPECT_EQ(mesh.face_count, 1u);
}

inline std::string binary_ply(bool big_endian, const std::string& coordinate_type, const std::string& count_type,
                              const std::string& index_type) {
    std::string bytes = std::string("ply\nformat ") + (big_endian ? "binary_big_endian" : "binary_little_endian") +
                        " 1.0\ncomment by hand\nelement vertex 4\nproperty " + coordinate_type + " x\nproperty " +
                        coordinate_type + " y\nproperty uchar red\nproperty " + coordinate_type +
                        " z\nproperty list uchar short extra\nelement face 1\n" +
                        "property float quality\nproperty list " + count_type + " " + index_type +
                        " vertex_indices\nproperty list uchar float texcoord\nend_header\n";
    const auto put_number = [&](const std::string& type, double value) {
        if (type == "float" || type == "float32")
            put(bytes, static_cast<float>(value), big_endian);
        else if (type == "double" || type == "float64")
            put(bytes, value, big_endian);
        else if (type.find("char") != std::string::npos || type.find("int8") != std::string::npos)
            put(bytes, static_cast<std::uint8_t>(value), big_endian);
        else if (type.find("short") != std::string::npos || type.find("int16") != std::string::npos)
            put(bytes, static_cast<std::uint16_t>(value), big_endian);
        else
            put(bytes, static_cast<std::uint32_t>(value), big_endian);
    };
    for (std::size_t i = 0; i < 4; ++i) {
        put_number(coordinate_type, square_vertices[3 * i]);
        put_number(coordinate_type, square_vertices[3 * i + 1]);
        put_number("uchar", 200);
        put_number(coordinate_type, square_vertices[3 * i + 2]);
        put_number("uchar", static_cast<double>(i));
        for (std::size_t j = 0; j < i; ++j) put_number("short", 7);
    }
    put_number("float", 0.25);
    put_number(count_type, 4);
    for (int i = 0; i < 4; ++i) put_number(index_type, i);
    put_number("uchar", 2);
    put_number("float", 1);
    put_number("float", 2);
    return bytes;
}

inline std::string binary_stl(const std::vector<std::vector<float>>& facets, const std::string& head = "made by hand") {
    std::string bytes = head;
    bytes.resize(80, ' ');
    put(bytes, static_cast<std::uint32_t>(facets.size()));
    for (const std::vector<float>& facet : facets) {
        for (int i = 0; i < 3; ++i) put(bytes, 0.0f);
        for (const float x : facet) put(bytes, x);
        put(bytes, std::uint16_t{0});
    }
    return bytes;
}

} // namespace raywise
