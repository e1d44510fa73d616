// Files that are damaged, or no mesh at all: every outcome is a mesh that can be used, or an Error that says where and why.
#include "io/mesh_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <sys/stat.h>

namespace raywise {
namespace {

const std::string binary_facets = binary_stl({{0, 0, 0, 1, 0, 0, 1, 1, 0.5f}, {0, 0, 1, 1, 0, 1, 1, 1, 1}});

// One small file of each form.
const std::vector<std::pair<std::string, std::string>> originals = {
    {"a.obj", "# a\nmtllib a.mtl\n" + square_obj + "vt 0 0\nvn 0 0 1\nf 1/1/1 \\\n -1 3//1\n"},
    {"a.off", square_off},
    {"b.off", "NCOFF\n3 1 0 # counts\n0 0 0 0 0 1 1 2 3\n1 0 0 0 0 1 4 5 6\n0 1.25 0 0 0 1 7 8 9\n3 0 1 2 9 9 9\n"},
    {"a.ply", square_ply},
    {"b.ply", binary_ply(false, "float", "uchar", "int")},
    {"c.ply", binary_ply(true, "double", "int", "uint")},
    {"a.stl", facet_stl},
    {"b.stl", binary_facets}};

class BadFiles : public MeshFiles {
protected:
    // Loads what may be anything. An Error has to say which file, why, and where.
    void expect_a_mesh_or_a_message(const std::string& name, const std::string& content) {
        try {
            const LoadedMesh mesh = load(name, content);
            ++loaded_;
            ASSERT_EQ(mesh.indices.size(), 3 * mesh.face_of_triangle.size());
            for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.vertex_count());
            for (const std::uint32_t face : mesh.face_of_triangle) ASSERT_LT(face, mesh.face_count);
            for (std::size_t i = 0; i < 3 * mesh.vertex_count(); ++i) ASSERT_TRUE(std::isfinite(mesh.coordinate(i)));
        } catch (const Error& error) {
            ++refused_;
            const std::string message = error.what();
            ASSERT_NE(message.find(name + ": "), std::string::npos) << message;
            ASSERT_GT(message.size(), message.find(name) + name.size() + 10) << message;
            if (error.status() == Status::ERROR_NO_FACES || content.empty()) return; // faults of the whole file
            const std::size_t place = std::max(message.rfind(" (line ") + 1, message.rfind(" (byte ") + 1);
            ASSERT_TRUE(place > 0 && message.back() == ')' && std::isdigit(message[place + 6]) != 0) << message;
        }
    }

    int loaded_ = 0;
    int refused_ = 0;
};

TEST_F(BadFiles, CutAtEveryByte) {
    for (const auto& [name, content] : originals) {
        for (std::size_t size = 0; size <= content.size(); ++size) {
            expect_a_mesh_or_a_message(name, content.substr(0, size));
            ASSERT_FALSE(HasFatalFailure()) << name << " of " << size << " bytes";
        }
    }
    EXPECT_GE(loaded_, 8);
    EXPECT_GT(refused_, 1000);
}

TEST_F(BadFiles, WithEveryBitOfEveryByteFlipped) {
    for (const auto& [name, content] : originals) {
        for (std::size_t at = 0; at < content.size(); ++at) {
            for (const int mask : {1, 2, 4, 8, 16, 32, 64, 128, 255}) {
                std::string damaged = content;
                damaged[at] = static_cast<char>(damaged[at] ^ mask);
                expect_a_mesh_or_a_message(name, damaged);
                ASSERT_FALSE(HasFatalFailure()) << name << ", byte " << at << " with " << mask;
            }
        }
    }
    EXPECT_GT(loaded_, 1000);
    EXPECT_GT(refused_, 1000);
}

TEST_F(BadFiles, OfOtherEncodings) {
    const auto wide = [](const std::string& text, const std::string& mark, int size, bool big_endian) {
        std::string bytes = mark;
        for (const char c : text) {
            for (int i = 0; i < size; ++i) bytes += (big_endian ? size - 1 - i : i) == 0 ? c : '\0';
        }
        return bytes;
    };
    const std::pair<const char*, std::string> files[] = {
        {"a.obj", square_obj}, {"a.off", square_off}, {"a.ply", square_ply}, {"a.stl", facet_stl}};
    for (const auto& [name, text] : files) {
        expect_error(name, wide(text, "\xFF\xFE", 2, false), Status::ERROR_FILE_FORMAT, "UTF-16");
        expect_error(name, wide(text, "\xFE\xFF", 2, true), Status::ERROR_FILE_FORMAT, "UTF-16");
        expect_error(name, wide(text, std::string("\xFF\xFE\0\0", 4), 4, false), Status::ERROR_FILE_FORMAT, "UTF-32");
        expect_error(name, wide(text, std::string("\0\0\xFE\xFF", 4), 4, true), Status::ERROR_FILE_FORMAT, "UTF-32");
    }
    expect_error("a.obj", wide(square_obj, "", 2, false), Status::ERROR_FILE_FORMAT, "zero byte (line 1)");
    expect_error("a.off", square_off.substr(0, 14) + '\0' + square_off.substr(14), Status::ERROR_FILE_FORMAT,
                 "zero byte (line 3)");
}

TEST_F(BadFiles, WithNumbersThatAreNone) {
    const std::string broken = "is no number";
    const std::string endless = "is no finite number";
    for (const auto& [word, reason] :
         std::vector<std::pair<std::string, std::string>>{{"0x1p3", broken},
                                                          {"0x10", broken},
                                                          {"1,5", "a decimal point has to be a point"},
                                                          {"1.5f", broken},
                                                          {"1e", broken},
                                                          {"1d5", broken},
                                                          {"--1", broken},
                                                          {"1.2.3", broken},
                                                          {".", broken},
                                                          {"1_000", broken},
                                                          {"one", broken},
                                                          {"-1.#IND", broken},
                                                          {"nan", endless},
                                                          {"-NaN", endless},
                                                          {"nan(ind)", endless},
                                                          {"inf", endless},
                                                          {"-Infinity", endless},
                                                          {"1e999", endless},
                                                          {"-1e309", endless}}) {
        const Status status = reason == endless ? Status::ERROR_NOT_FINITE : Status::ERROR_FILE_FORMAT;
        const std::string element = " 0: \"" + word + "\" ";
        expect_error("a.obj", "v 0 0 " + word + "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", status, "vertex" + element);
        expect_error("a.obj", "v 0 0 " + word + "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", status, reason + " (line 1)");
        expect_error("a.off", "OFF\n3 1 0\n" + word + " 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", status, reason + " (line 3)");
        expect_error("a.stl", "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 " + word + " 0\n", status,
                     reason + " (line 4)");
        std::string ply = square_ply;
        ply.replace(ply.find("float x"), 7, "double x");
        ply.replace(ply.find("0 0 0\n"), 1, word);
        expect_error("a.ply", ply, status, reason + " (line 10)");
    }
}

TEST_F(BadFiles, WithAPlaceForEveryFault) {
    const auto expect = [this](const char* name, const std::string& content, Status status, const char* message) {
        expect_error(name, content, status, message);
    };
    const Status format = Status::ERROR_FILE_FORMAT;
    expect("a.obj", "\xEF\xBB\xBFv 0 0 0\n\r\n\rv 0 \\\n x 0\n", format, "vertex 1: \"x\" is no number (line 5)");
    expect("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 4\nv 0 0 1\nf 3 \\\n2 6\n# end\n",
           Status::ERROR_INDEX_OUT_OF_RANGE, "face 1: index 6 is out of range, the mesh has 4 vertices (line 7)");
    expect("a.obj", square_obj + "f 1 2\n", Status::ERROR_BAD_POLYGON,
           "face 1 has 2 corners, it needs at least 3 (line 6)");
    expect("a.obj", square_obj + "f 1 2 3 \\\nf 1 3 4\n", format, "face 1: \"f\" is no corner (line 6)");
    expect("a.obj", square_obj + "f 1.0 2 3\n", format, "face 1: \"1.0\" is no corner (line 6)");
    expect("a.obj", square_obj + "f 1/1/1/1 2 3\n", format, "face 1: \"1/1/1/1\" is no corner (line 6)");
    expect("a.off", "\n# a\nOFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n\n4 0 1 2 -1\n", Status::ERROR_INDEX_OUT_OF_RANGE,
           "face 0: index -1 is out of range, the mesh has 4 vertices (line 10)");
    expect("a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 3\n# no more\n", format,
           "face 1 of 2 is missing (line 8)");
    expect("a.ply", "ply\nformat ascii 1.0\nelement face one\n", format,
           "\"face\" there are: \"one\" is no count (line 3)");
    expect("a.ply", square_ply.substr(0, square_ply.size() - 2), format,
           "the file is truncated: face 0 is not complete (line 14)");
    std::string binary = binary_ply(false, "float", "uchar", "int");
    const std::string header_size = std::to_string(binary.find("end_header\n") + 11);
    expect("a.ply", binary.substr(0, binary.find("end_header\n") + 13), format,
           ("vertex 0 is not complete (byte " + header_size + ")").c_str());
    expect("a.ply", "\xEF\xBB\xBF" + binary.substr(0, binary.size() - 14), format,
           ("(byte " + std::to_string(binary.size() + 3 - 17) + ")").c_str());
    std::string stl = binary_facets;
    const float nan = std::nanf("");
    std::memcpy(stl.data() + 84 + 50 + 12 + 16, &nan, sizeof nan);
    expect("a.stl", stl, Status::ERROR_NOT_FINITE, "face 1: coordinate y of corner 1 is NaN (byte 162)");
    expect("a.stl", "solid a\r\rfacet normal 0 0 1\router loop\rvertex 0 0\rendloop", format,
           "face 0: \"endloop\" is no number (line 6)");
}

// Long lines and many lines take time in proportion: what looked for each line's end through the rest would take for ever.
TEST_F(BadFiles, OfMegabytesInOneLineOrInManyShortOnes) {
    constexpr std::size_t size = 4 << 20;
    const std::string blanks(size, ' ');
    const std::string digits(size, '0');
    expect_square(load("a.obj", "#" + blanks + "\nv 0 0 0\nv 1." + digits + " 0" + blanks +
                                    "0\nv 1 1 0.5\nv 0 1 0\nf 1/" + digits + " 2 3 4" + blanks));
    expect_error("a.obj", digits, Status::ERROR_FILE_FORMAT, "no line of an OBJ file");
    expect_error("a.obj", "v " + digits, Status::ERROR_FILE_FORMAT, "vertex 0 has too few coordinates (line 1)");
    expect_error("a.obj", "f 1 2 " + digits + "x", Status::ERROR_FILE_FORMAT, "is no corner (line 1)");
    expect_error("a.off", blanks + "OFF" + digits, Status::ERROR_FILE_FORMAT, "(line 1)");
    expect_error("a.ply", "ply" + blanks + digits, Status::ERROR_FILE_FORMAT, "(line 1)");
    expect_error("a.stl", "solid" + blanks + digits, Status::ERROR_FILE_FORMAT, "endsolid is missing (line 1)");
    for (const char* end : {"\r", "\n", "\r\n"}) {
        std::string lines;
        while (lines.size() < size) lines += end;
        expect_square(load("a.obj", lines + square_obj));
        expect_square(load("a.off", lines + square_off));
        expect_square(load("a.ply", lines + square_ply));
        EXPECT_EQ(load("a.stl", lines + facet_stl).face_count, 1u);
    }
    const std::string facet =
        "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0.5 endloop endfacet ";
    std::string facets = "solid ";
    std::string solids;
    std::string statements = "v 0 0 0 \\\n\rv 1 0 0\rv 0 1 0\r";
    std::uint32_t count = 0;
    for (; facets.size() < size; ++count) {
        facets += facet;
        solids += "solid a " + facet + "endsolid a ";
        statements += "f 1 2 3\r";
    }
    EXPECT_EQ(load("a.stl", facets + "endsolid").face_count, count);
    EXPECT_EQ(load("a.stl", solids).face_count, count);
    EXPECT_EQ(load("a.obj", statements).face_count, count);
}

TEST_F(BadFiles, WithCountsThatNoFileHolds) {
    for (const char* count : {"2147483648", "4294967295", "18446744073709551615"}) {
        expect_error("a.off", std::string("OFF\n") + count + " 1 0\n0 0 0\n", Status::ERROR_TOO_MANY,
                     "vertices (line 2)");
        expect_error("a.off", std::string("OFF\n1 ") + count + " 0\n0 0 0\n", Status::ERROR_TOO_MANY, "faces (line 2)");
        for (const char* element : {"vertex 4", "face 1"}) {
            std::string ply = square_ply;
            const std::string name(element, std::strchr(element, ' ') + 1);
            ply.replace(ply.find(element), std::strlen(element), name + count);
            expect_error("a.ply", ply, Status::ERROR_TOO_MANY, "more than 2147483646");
        }
    }
    expect_error("a.off", "OFF\n18446744073709551616 1 0\n", Status::ERROR_FILE_FORMAT, "number of vertices");
    expect_error("a.off", "OFF\n2000000000 2000000000 0\n0 0 0\n", Status::ERROR_FILE_FORMAT,
                 "vertex 1 of 2000000000 is missing");
    expect_error("a.off", "OFF\n3 -1 0\n", Status::ERROR_FILE_FORMAT,
                 "number of faces is missing: \"-1\" is none (line 2)");
    std::string ply = square_ply;
    ply.replace(ply.find("4 0 1 2 3"), 1, "2147483648");
    expect_error("a.ply", ply, Status::ERROR_TOO_MANY, "corners (line 14)");
    ply = square_ply;
    ply.replace(ply.find("4 0 1 2 3"), 1, "-1");
    expect_error("a.ply", ply, Status::ERROR_BAD_POLYGON, "face 0 has -1 corners, it needs at least 3 (line 14)");
    expect_error("a.ply",
                 "ply\nformat ascii 1.0\nelement list 2000000000000\nproperty list int int a\n" + square_ply.substr(21),
                 Status::ERROR_FILE_FORMAT, "\"list\" 6: \"0.5\" is no integer (line 14)");
}

TEST_F(BadFiles, ThatAreNoFiles) {
    const auto expect_unreadable = [](const std::filesystem::path& path) {
        try {
            load_mesh(path);
            ADD_FAILURE() << path;
        } catch (const Error& error) {
            EXPECT_EQ(error.status(), Status::ERROR_FILE_UNREADABLE) << error.what();
            EXPECT_NE(std::string(error.what()).find("is no plain file"), std::string::npos) << error.what();
        }
    };
    const std::filesystem::path pipe = files_.folder() / "pipe.obj";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    expect_unreadable(pipe);
    expect_unreadable("/dev/null");
    expect_unreadable("/dev/zero");
    expect_unreadable(files_.folder());
    std::filesystem::create_symlink("/dev/zero", files_.folder() / "zero.ply");
    expect_unreadable(files_.folder() / "zero.ply");
    std::filesystem::create_symlink("nowhere.ply", files_.folder() / "nothing.ply");
    EXPECT_THROW(load_mesh(files_.folder() / "nothing.ply"), Error);
}

TEST_F(BadFiles, AreNamedByPathsOfAnyBytes) {
    expect_square(load("\xFF\xFE not UTF-8.obj", square_obj));
    expect_error("\xC3 not UTF-8.obj", "v 0 0\n", Status::ERROR_FILE_FORMAT, "too few coordinates (line 1)");
}

} // namespace
} // namespace raywise
