// Mesh files: what is read comes out as it is in the file, and whatever is wrong is named.
#include "io/mesh_files.h"
#include "io/text_source.h"

#include <cmath>
#include <locale>
#include <random>
#include <thread>
#include <utility>

namespace raywise {
namespace {

class MeshFile : public MeshFiles {};

TEST_F(MeshFile, ReadsASquareFromEveryTextFormat) {
    expect_square(load("a.obj", square_obj));
    expect_square(load("a.off", square_off));
    expect_square(load("a.ply", square_ply));
}

TEST_F(MeshFile, DoesNotCareAboutTheCaseOfTheEnding) {
    expect_square(load("a.OBJ", square_obj));
    expect_square(load("a.Off", square_off));
    expect_square(load("a.PLY", square_ply));
    EXPECT_EQ(load("a.STL", facet_stl).face_count, 1u);
}

TEST_F(MeshFile, ReadsNamesWithSpacesAndLettersOutsideAscii) {
    expect_square(load("ein W\xC3\xBCrfel 1.0.off", square_off));
    expect_square(load("off.obj", square_obj));
    expect_square(load(".ply.ply", square_ply));
}

TEST_F(MeshFile, CutsConvexPolygonsIntoFansInTheOrderOfTheirCorners) {
    const LoadedMesh mesh =
        load("a.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 5\nf 3 4 5 1 2\nf 4 3 2\n");
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 4, 2, 3, 4, 2, 4, 0, 2, 0, 1, 3, 2, 1}));
    EXPECT_EQ(mesh.face_of_triangle, (Indices{0, 1, 1, 1, 2}));
    EXPECT_EQ(mesh.face_count, 3u);
}

TEST_F(MeshFile, CutsConcavePolygonsInside) {
    const Indices expected = {1, 2, 3, 0, 1, 3}; // concave at the last corner
    const std::string off = "4 2 0\n0 0 0\n4 -2 0\n0 4 0\n1 0 0\n4 0 1 2 3\n4 3 2 1 0\n";
    const LoadedMesh mesh = load("a.off", "OFF\n" + off);
    EXPECT_EQ(mesh.indices, (Indices{1, 2, 3, 0, 1, 3, 3, 2, 1, 3, 1, 0})) << "the second from its first corner";
    EXPECT_EQ(mesh.face_of_triangle, (Indices{0, 0, 1, 1}));
    EXPECT_EQ(load("a.obj", "v 0 0 0\nv 4 -2 0\nv 0 4 0\nv 1 0 0\nf 1 2 3 4\n").indices, expected);
    EXPECT_EQ(load("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                   "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                   "0 0 0\n4 -2 0\n0 4 0\n1 0 0\n4 0 1 2 3\n")
                  .indices,
              expected);
}

TEST_F(MeshFile, KeepsMeshesThatAreNoManifolds) {
    // Three triangles at one edge, one of them twice, and one the other way round.
    const LoadedMesh mesh =
        load("a.off", "OFF\n5 5 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n3 0 1 2\n3 2 1 0\n");
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 2, 2, 1, 0}));
}

TEST_F(MeshFile, KeepsFacesWithRepeatedCorners) {
    const Indices expected = {0, 0, 1, 0, 1, 2, 0, 1, 1, 0, 1, 3, 0, 1, 3};
    const LoadedMesh obj = load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 1 2\nf 1 2 3\nf 1 2 2 4\nf 1 2 4\n");
    EXPECT_EQ(obj.indices, expected);
    EXPECT_EQ(obj.face_of_triangle, (Indices{0, 1, 2, 2, 3}));
    EXPECT_EQ(load("a.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 0 1\n3 0 1 2\n4 0 1 1 3\n3 0 1 3\n").indices,
              expected);
}

TEST_F(MeshFile, KeepsVerticesThatNoFaceUses) {
    EXPECT_EQ(load("a.obj", "v 9 9 9\n" + square_obj + "v 7 7 7\nf 2 3 4\n").vertex_count(), 6u);
}

TEST_F(MeshFile, ReadsWhatElseAnObjFileMayHold) {
    expect_square(load("a.obj",
                       "# made by hand\r\nmtllib nowhere.mtl\r\no square\r\nv 0 0 0 1.0\r\nv 1 0 0 0.5 0.5 0.5\r\nvt "
                       "0.5\r\nvn 0 0 1\r\n"
                       "v +1.0 1e0 5e-1 # corner 7\r\nv\t0\t1.\t.0\r\ng part\r\nusemtl red\r\ns off\r\nl 1 2\r\nf "
                       "1/1/1 2//1 \\\r\n  3/1 -1 # 9\r\n"));
    expect_square(load("b.obj", "v 0 0 0\rv 1 0 0\rv 1 1 0.5\rv 0 1 0\rf 1 2 3 4"));
    EXPECT_EQ(load("c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nfo 1 2 3\n").face_count, 1u)
        << "as the oldest files write faces";
}

TEST_F(MeshFile, ReadsFacesBeforeTheirVertices) {
    expect_square(load("a.obj", "f 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\n"));
}

TEST_F(MeshFile, CountsNegativeIndicesFromTheLatestVertex) {
    const LoadedMesh mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -4 -1 -2\n");
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 0, 3, 2}));
}

TEST_F(MeshFile, ReadsWhatElseAnOffFileMayHold) {
    expect_square(load("a.off",
                       "# comment\nOFF # and another\n\n4 1 0 # counts\n0 0 0\n\n1 0 0 # first\n1 1 0.5\r\n0 1 0\n4 0 "
                       "1 2 3 255 0 0\n"));
    expect_square(load("b.off", "OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 3"));
    expect_square(load("c.off", "OFF\n4 1\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4\t0\t1\t2\t3\n"));
    expect_square(
        load("d.off",
             "COFF\n4 1 0\n0 0 0 255 0 0 255\n1 0 0 1 2 3 4\n1 1 0.5 0.5 0.5 0.5 1\n0 1 0\n4 0 1 2 3 0.1 0.2 0.3\n"));
    expect_square(
        load("e.off", "NOFF\n4 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0.5 0 0 1\n0 1 0 0 0 1\n4 0 1 2 3 7 7 7\n"));
    expect_square(load("f.off", "STOFF\n4 1 0\n0 0 0 0 0\n1 0 0 0 1\n1 1 0.5 1 1\n0 1 0 1 0\n4 0 1 2 3\n"));
    expect_square(load("g.off", square_off)); // none of the headers before may linger
}

TEST_F(MeshFile, ReadsPlyInEveryEncodingAndType) {
    for (const bool big_endian : {false, true}) {
        for (const char* coordinate : {"float", "double", "float32", "float64"}) {
            for (const char* count : {"uchar", "char", "uint8", "int8", "short", "ushort", "int16", "uint16", "int",
                                      "uint", "int32", "uint32"}) {
                for (const char* index : {"int", "uint", "int32", "uint32", "short", "ushort", "uchar", "char"}) {
                    SCOPED_TRACE(std::string(coordinate) + " " + count + " " + index +
                                 (big_endian ? ", big endian" : ", little endian"));
                    expect_square(load("a.ply", binary_ply(big_endian, coordinate, count, index)));
                }
            }
        }
    }
}

TEST_F(MeshFile, ReadsPlyFilesOfAnotherOrder) {
    expect_square(load("a.ply",
                       "ply\r\nformat ascii 1.0\r\nobj_info x\r\nelement camera 2\r\nproperty float a\r\nproperty list "
                       "uchar int b\r\nelement face 1\r\n"
                       "property uchar red\r\nproperty list int uint vertex_index\r\nelement vertex 4\r\nproperty "
                       "double z\r\nproperty float nx\r\n"
                       "property double x\r\nproperty double y\r\nend_header\r\n0.5 2 7 8\r\n0.5 0\r\n255 4 0 1 2 "
                       "3\r\n0 9 0 0\r\n0 9 1 0\r\n0.5 9 1 1\r\n0 9 0 1"));
}

TEST_F(MeshFile, CutsPlyTriangleStripsIntoFaces) {
    const LoadedMesh mesh = load(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement "
        "tristrips 1\n"
        "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 -1 4 3 1\n");
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 1})) << "all the same way round";
    EXPECT_EQ(mesh.face_of_triangle, (Indices{0, 1, 2, 3}));
}

TEST_F(MeshFile, ReadsStlInBothEncodings) {
    const LoadedMesh ascii = load("a.stl", facet_stl);
    EXPECT_EQ(floats(ascii), (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0.5f}));
    EXPECT_EQ(ascii.indices, (Indices{0, 1, 2}));
    const std::vector<float> facet = {0, 0, 0, 1, 0, 0, 1, 1, 0.5f};
    EXPECT_EQ(floats(load("b.stl", binary_stl({facet}))), facet);
    EXPECT_EQ(floats(load("c.stl", binary_stl({facet}, "solid but binary"))), facet);
    // Near and repeated corners, facets without area: nothing is merged, nothing is dropped.
    const LoadedMesh all =
        load("d.stl", binary_stl({facet, {1, 1, 1, 1, 1, 1, 2, 2, 2}, {1e-39f, 0, 0, 2e-39f, 0, 0, 0, 1, 0}, facet}));
    EXPECT_EQ(all.face_count, 4u);
    EXPECT_EQ(floats(all)[18], 1e-39f);
    EXPECT_EQ(floats(load("e.stl",
                          "SOLID a\n FACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX +0 0 0\nVERTEX 1 0 0\nVERTEX 1 1 "
                          "5E-1\nENDLOOP\nENDFACET\nENDSOLID")),
              facet);
    EXPECT_EQ(load("f.stl", facet_stl + facet_stl).face_count, 2u) << "several solids in one file";
}

TEST_F(MeshFile, NamesAMissingFile) {
    for (const char* name : {"nowhere.obj", "nowhere.xyz", "no/where.ply"}) {
        try {
            load_mesh(files_.folder() / name);
            FAIL();
        } catch (const Error& error) {
            EXPECT_EQ(error.status(), Status::ERROR_FILE_NOT_FOUND) << name;
        }
    }
    EXPECT_THROW(load_mesh(""), Error);
}

TEST_F(MeshFile, NamesAFolder) {
    std::filesystem::create_directory(files_.folder() / "folder.obj");
    try {
        load_mesh(files_.folder() / "folder.obj");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), Status::ERROR_FILE_UNREADABLE);
    }
}

TEST_F(MeshFile, NamesAFileWithoutPermission) {
    const std::filesystem::path path = files_.write("secret.obj", square_obj);
    std::filesystem::permissions(path, std::filesystem::perms::none);
    try {
        load_mesh(path);
        GTEST_SKIP() << "this user may read everything";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), Status::ERROR_FILE_UNREADABLE);
    }
}

TEST_F(MeshFile, NamesAnUnknownEnding) {
    expect_error("a.xyz", square_obj, Status::ERROR_FILE_FORMAT, ".xyz");
    expect_error("obj", square_obj, Status::ERROR_FILE_FORMAT, "none of");
    expect_error("a.obj.gz", square_obj, Status::ERROR_FILE_FORMAT, ".gz");
}

TEST_F(MeshFile, NamesContentOfAnotherKind) {
    const std::string picture("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
    for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl"}) {
        expect_error(name, picture, Status::ERROR_FILE_FORMAT, "");
        expect_error(name, "", Status::ERROR_FILE_FORMAT, "empty");
        expect_error(name, "hello world\n", Status::ERROR_FILE_FORMAT, "");
        expect_error(name, std::string(300, '\0'), Status::ERROR_FILE_FORMAT, "");
    }
    expect_error("a.off", square_ply, Status::ERROR_FILE_FORMAT, "OFF");
    expect_error("a.ply", square_off, Status::ERROR_FILE_FORMAT, "ply");
    expect_error("a.off", "OFF BINARY\n", Status::ERROR_FILE_FORMAT, "binary");
    expect_error("a.off", "4OFF\n1 1 1\n", Status::ERROR_FILE_FORMAT, "dimensions");
}

TEST_F(MeshFile, NamesATruncatedFile) {
    for (std::size_t size = 0; size + 12 < square_ply.size(); size += 3)
        expect_error("a.ply", square_ply.substr(0, size), Status::ERROR_FILE_FORMAT, "");
    for (std::size_t size = 8; size + 12 < square_off.size(); size += 3)
        expect_error("a.off", square_off.substr(0, size), Status::ERROR_FILE_FORMAT, "");
    const std::string binary = binary_ply(false, "float", "uchar", "int");
    for (std::size_t size = 0; size + 9 < binary.size(); ++size)
        expect_error("a.ply", binary.substr(0, size), Status::ERROR_FILE_FORMAT, "");
    const std::string stl = binary_stl({{0, 0, 0, 1, 0, 0, 1, 1, 0.5f}, {0, 0, 0, 1, 0, 0, 1, 1, 0.5f}});
    for (std::size_t size = 0; size < stl.size(); ++size)
        expect_error("a.stl", stl.substr(0, size), Status::ERROR_FILE_FORMAT, "");
    for (std::size_t size = 6; size + 12 < facet_stl.size(); ++size)
        expect_error("a.stl", facet_stl.substr(0, size), Status::ERROR_FILE_FORMAT, "");
}

TEST_F(MeshFile, NamesAFileWithoutFaces) {
    expect_error("a.obj", "v 0 0 0\n", Status::ERROR_NO_FACES, "no faces");
    expect_error("a.off", "OFF\n1 0 0\n0 0 0\n", Status::ERROR_NO_FACES, "no faces");
    expect_error("a.ply",
                 "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
                 "z\nend_header\n0 0 0\n",
                 Status::ERROR_NO_FACES, "no faces");
    expect_error("a.stl", binary_stl({}), Status::ERROR_NO_FACES, "no faces");
    expect_error("a.stl", "solid a\nendsolid a\n", Status::ERROR_NO_FACES, "no faces");
}

TEST_F(MeshFile, NamesAFaceWithTooFewCorners) {
    expect_error("a.obj", square_obj + "f 1 2\n", Status::ERROR_BAD_POLYGON, "face 1 has 2 corners");
    expect_error("a.obj", square_obj + "f 1 2 3\nf\n", Status::ERROR_BAD_POLYGON, "face 2 has 0 corners");
    expect_error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1 0\n", Status::ERROR_BAD_POLYGON, "face 0 has 1 corner,");
    std::string ply = square_ply;
    ply.replace(ply.find("4 0 1 2 3"), 9, "2 0 1");
    expect_error("a.ply", ply, Status::ERROR_BAD_POLYGON, "face 0 has 2 corners");
    std::string stl = facet_stl;
    stl.replace(stl.find("vertex 1 1 0.5\n"), 15, "");
    expect_error("a.stl", stl, Status::ERROR_BAD_POLYGON, "face 0 has 2 corners");
}

TEST_F(MeshFile, NamesAnIndexOutOfRange) {
    expect_error("a.obj", square_obj + "f 1 2 9000\n", Status::ERROR_INDEX_OUT_OF_RANGE,
                 "face 1: index 9000 is out of range, the mesh has 4 vertices (line 6)");
    expect_error("a.obj", square_obj + "f 1 2 0\n", Status::ERROR_INDEX_OUT_OF_RANGE, "face 1: index 0");
    expect_error("a.obj", square_obj + "f 1 2 -5\n", Status::ERROR_INDEX_OUT_OF_RANGE, "face 1: index -5");
    expect_error("a.obj", square_obj + "f 1 2 4294967297\n", Status::ERROR_INDEX_OUT_OF_RANGE, "4294967297");
    expect_error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", Status::ERROR_INDEX_OUT_OF_RANGE,
                 "face 0: index 3 is out of range, the mesh has 3 vertices");
    expect_error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", Status::ERROR_INDEX_OUT_OF_RANGE, "index -1");
    std::string ply = square_ply;
    ply.replace(ply.find("4 0 1 2 3"), 9, "4 0 1 2 4");
    expect_error("a.ply", ply, Status::ERROR_INDEX_OUT_OF_RANGE, "face 0: index 4");
    std::string binary = binary_ply(true, "double", "uchar", "int");
    binary.replace(binary.size() - 13, 4, "\xFF\xFF\xFF\xFF");
    expect_error("a.ply", binary, Status::ERROR_INDEX_OUT_OF_RANGE, "index -1");
}

TEST_F(MeshFile, NamesACoordinateThatIsNotFinite) {
    for (const char* number : {"nan", "inf", "-inf", "1e309", "1e400", "-1e999", "Infinity", "NaN"}) {
        expect_error("a.obj", "v 0 0 0\nv 1 " + std::string(number) + " 0\nv 0 1 0\nf 1 2 3\n",
                     Status::ERROR_NOT_FINITE, "vertex 1: " + io::quoted(number) + " is no finite number (line 2)");
        expect_error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 " + std::string(number) + "\n0 1 0\n3 0 1 2\n",
                     Status::ERROR_NOT_FINITE, "vertex 1");
        std::string stl = facet_stl;
        stl.replace(stl.find("0.5"), 3, number);
        expect_error("a.stl", stl, Status::ERROR_NOT_FINITE, "face 0");
    }
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expect_error("b.stl", binary_stl({{0, 0, 0, 1, 0, 0, 1, nan, 0}}), Status::ERROR_NOT_FINITE,
                 "face 0: coordinate y of corner 2 is NaN");
    std::string ply = binary_ply(false, "double", "uchar", "int");
    const double infinite = std::numeric_limits<double>::infinity();
    std::string bytes;
    put(bytes, infinite);
    ply.replace(ply.find("end_header\n") + 11 + 8, 8, bytes);
    expect_error("a.ply", ply, Status::ERROR_NOT_FINITE, "vertex 0: coordinate y is infinite");
}

TEST_F(MeshFile, NamesAWordThatIsNoNumber) {
    for (const char* word : {"abc", "1,5", "0x10", "1.5f", "--1", "1e", "+-1"}) {
        expect_error("a.obj", "v 0 0 0\nv 1 " + std::string(word) + " 0\nv 0 1 0\nf 1 2 3\n", Status::ERROR_FILE_FORMAT,
                     "vertex 1: " + io::quoted(word) + " is no number");
    }
    expect_error("a.obj", "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n", Status::ERROR_FILE_FORMAT,
                 "vertex 1 has too few coordinates (line 2)");
    expect_error("a.obj", square_obj + "f 1 x 3\n", Status::ERROR_FILE_FORMAT, "face 1: \"x\" is no corner (line 6)");
    expect_error("a.obj", square_obj + "f /1 /2 /3\n", Status::ERROR_FILE_FORMAT, "face 1");
    expect_error("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 x\n", Status::ERROR_FILE_FORMAT, "face 0");
}

// Messages go to terminals, which obey control characters.
TEST_F(MeshFile, QuotesWordsFitForTerminals) {
    const std::string word = "\x1B[2J\x7F\xFF" + std::string(500, 'x');
    const std::pair<const char*, std::string> files[] = {
        {"a.obj", "v 0 " + word + " 0\n"},
        {"a.obj", square_obj + "f 1 " + word + " 3\n"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 " + word + "\n"},
        {"a.ply", "ply\nformat " + word + "\n"},
        {"a.ply", "ply\nformat ascii 1.0\n" + word + "\nend_header\n"},
        {"a.ply", "ply\nformat ascii 1.0\nelement " + word + " x\nend_header\n"},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty " + word + " x\nend_header\n"},
        {"a.stl", "solid\n" + word + "\n"},
        {"a.stl", "solid\nfacet " + word + "\n"},
    };
    for (const auto& [name, content] : files) {
        try {
            load_mesh(files_.write(name, content));
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find("\"?[2J??xxx"), std::string::npos) << message;
            EXPECT_EQ(message.find_first_of("\x1B\x7F\xFF"), std::string::npos);
            EXPECT_LT(message.size(), 300u);
        }
    }
}

TEST_F(MeshFile, NamesCountsBeyondTheIds) {
    expect_error("a.off", "OFF\n4294967296 1 0\n", Status::ERROR_TOO_MANY, "vertices");
    expect_error("a.off", "OFF\n1 4294967296 0\n", Status::ERROR_TOO_MANY, "faces");
    std::string ply = square_ply;
    ply.replace(ply.find("face 1"), 6, "face 9999999999");
    expect_error("a.ply", ply, Status::ERROR_TOO_MANY, "faces");
}

TEST_F(MeshFile, NamesPlyHeadersItCannotFollow) {
    const auto with = [](const std::string& from, const std::string& to) {
        std::string ply = square_ply;
        ply.replace(ply.find(from), from.size(), to);
        return ply;
    };
    expect_error("a.ply", with("ascii", "text"), Status::ERROR_FILE_FORMAT, "format");
    expect_error("a.ply", with("property float y\n", ""), Status::ERROR_FILE_FORMAT, "x, y and z");
    expect_error("a.ply", with("float z", "float x"), Status::ERROR_FILE_FORMAT, "once each");
    expect_error("a.ply", with("float z", "quad z"), Status::ERROR_FILE_FORMAT, "unknown type");
    expect_error("a.ply", with("vertex_indices", "corners"), Status::ERROR_FILE_FORMAT, "vertex indices");
    expect_error("a.ply", with("list uchar", "list float"), Status::ERROR_FILE_FORMAT, "floats");
    expect_error("a.ply", with("end_header", "end"), Status::ERROR_FILE_FORMAT, "unknown word");
    expect_error("a.ply", with("element face", "element vertex"), Status::ERROR_FILE_FORMAT, "two elements");
    expect_error("a.ply", with("element vertex 4\n", ""), Status::ERROR_FILE_FORMAT, "before the first element");
    expect_error("a.ply", with("vertex 4", "vertex many"), Status::ERROR_FILE_FORMAT, "how many");
}

// Every byte changed or cut: either a mesh that can be used, or an Error; never a crash, never a word printed.
TEST_F(MeshFile, SurvivesDamagedFiles) {
    const std::vector<std::pair<std::string, std::string>> originals = {
        {"a.obj", square_obj + "vt 0 0\nvn 0 0 1\nf 1/1/1 -1 3//1\n"},
        {"a.off", square_off},
        {"b.off", "COFF\n3 1 0\n0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n3 0 1 2 9 9 9\n"},
        {"a.ply", square_ply},
        {"b.ply", binary_ply(false, "float", "uchar", "int")},
        {"c.ply", binary_ply(true, "double", "int", "uint")},
        {"a.stl", facet_stl},
        {"b.stl", binary_stl({{0, 0, 0, 1, 0, 0, 1, 1, 0.5f}})}};
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    std::mt19937 random(5);
    int loaded = 0;
    for (const auto& [name, content] : originals) {
        for (int trial = 0; trial < 1200; ++trial) {
            std::string damaged = content;
            for (unsigned change = 0; change <= trial % 3u; ++change) {
                const std::size_t at = random() % damaged.size();
                switch (random() % 5) {
                    case 0:
                        damaged[at] = static_cast<char>(random());
                        break;
                    case 1:
                        damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
                        break;
                    case 2:
                        damaged.erase(at, 1 + random() % 8);
                        break;
                    case 3:
                        damaged.insert(at, content.substr(random() % content.size(), random() % 20));
                        break;
                    default:
                        damaged.resize(at + 1);
                        break;
                }
                if (damaged.empty()) damaged = " ";
            }
            try {
                const LoadedMesh mesh = load(name, damaged);
                ++loaded;
                ASSERT_EQ(mesh.indices.size(), 3 * mesh.face_of_triangle.size());
                for (const std::uint32_t index : mesh.indices)
                    ASSERT_LT(index, mesh.vertex_count()) << name << "\n" << damaged;
                for (const std::uint32_t face : mesh.face_of_triangle) ASSERT_LT(face, mesh.face_count);
                for (std::size_t i = 0; i < 3 * mesh.vertex_count(); ++i)
                    ASSERT_TRUE(std::isfinite(mesh.coordinate(i)));
            } catch (const Error&) {
            }
        }
    }
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_GT(loaded, 100);
}

// Numbers with a decimal comma and grouping, as a host program may have made them the global C++ locale.
class CommaNumbers : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST_F(MeshFile, DoesNotCareAboutTheLocale) {
    const std::locale before;
    const std::locale comma(before, new CommaNumbers);
    std::locale::global(comma);
    std::vector<LoadedMesh> meshes = {load("a.obj", square_obj), load("a.off", square_off), load("a.ply", square_ply)};
    const bool kept = std::use_facet<std::numpunct<char>>(std::locale()).decimal_point() == ',';
    std::locale::global(before);
    EXPECT_TRUE(kept) << "the host's locale has to be as it was";
    for (const LoadedMesh& mesh : meshes) expect_square(mesh);
}

TEST_F(MeshFile, LoadsInManyThreadsAtOnce) {
    const std::vector<std::filesystem::path> paths = {
        files_.write("a.obj", square_obj), files_.write("a.off", square_off),
        files_.write("b.off", "NOFF\n4 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0.5 0 0 1\n0 1 0 0 0 1\n4 0 1 2 3\n"),
        files_.write("a.ply", square_ply), files_.write("b.ply", binary_ply(true, "double", "uchar", "uint"))};
    std::vector<std::thread> threads;
    std::vector<int> faults(4, 0);
    for (std::size_t t = 0; t < faults.size(); ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t i = 0; i < 50; ++i) {
                const LoadedMesh mesh = load_mesh(paths[(i + t) % paths.size()]);
                if (floats(mesh) != square_vertices || mesh.indices != Indices{0, 1, 2, 0, 2, 3}) ++faults[t];
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(faults, std::vector<int>(4, 0));
}

} // namespace
} // namespace raywise
