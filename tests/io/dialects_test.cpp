// Files as programs really write them, whatever the format's description says.
#include "io/mesh_files.h"

namespace raywise {
namespace {

class Dialects : public MeshFiles {};

const std::string byte_order_mark = "\xEF\xBB\xBF";

std::string with_line_ends(std::string text, const std::string& end) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
        text.replace(at, 1, end);
    return text;
}

void expect_facet(const LoadedMesh& mesh) {
    EXPECT_EQ(floats(mesh), (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0.5f}));
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2}));
}

TEST_F(Dialects, OfTextBeginWithAByteOrderMarkOrBlankLinesAndEndInZeroBytes) {
    const std::string zeros(1000, '\0');
    for (const std::string& start :
         {byte_order_mark, std::string("\n\n"), std::string("\r\n \t\r\n"), byte_order_mark + "\n"}) {
        expect_square(load("a.obj", start + square_obj + zeros));
        expect_square(load("a.off", start + square_off + zeros));
        expect_square(load("a.ply", start + square_ply + zeros));
        expect_facet(load("a.stl", start + facet_stl + zeros));
    }
    expect_square(load("b.ply", byte_order_mark + binary_ply(false, "float", "uchar", "int")));
}

TEST_F(Dialects, OfTextEndLinesInThreeWays) {
    for (const char* end : {"\n", "\r\n", "\r"}) {
        expect_square(load("a.obj", with_line_ends(square_obj, end)));
        expect_square(load("a.off", with_line_ends(square_off, end)));
        expect_square(load("a.ply", with_line_ends(square_ply, end)));
        expect_facet(load("a.stl", with_line_ends(facet_stl, end)));
    }
    expect_square(load("a.obj", "v 0 0 0\rv 1 0 0\nv 1 1 0.5\r\nv 0 1 0\n\rf 1 2 3 4"));
}

// The numbers behind a header may begin with what looks like half a line end.
TEST_F(Dialects, OfBinaryPlyEndHeaderLinesInThreeWays) {
    const std::string bytes = binary_ply(false, "float", "uchar", "int");
    const std::size_t size = bytes.find("end_header\n") + 11;
    for (const char* end : {"\n", "\r\n", "\r"}) {
        std::string changed = with_line_ends(bytes.substr(0, size), end) + bytes.substr(size);
        expect_square(load("a.ply", changed));
        const float x = 10.0f * 0x1p-145f; // the byte 0A, then zeros
        std::memcpy(changed.data() + changed.size() - (bytes.size() - size), &x, sizeof x);
        EXPECT_EQ(floats(load("a.ply", changed)).at(0), x) << "header lines end in " << std::string(end).size();
    }
}

TEST_F(Dialects, OfObjContinueStatementsButNeverPathsOrComments) {
    for (const char* line :
         {"# C:\\models\\", "mtllib C:\\m\\", "usemtl \\", "g a\\", "o \\  ", "# \\\t", "\\", "vn 0 0 1 \\"}) {
        for (const char* end : {"\n", "\r\n", "\r"}) expect_square(load("a.obj", std::string(line) + end + square_obj));
        expect_square(load("a.obj", square_obj + line));
    }
    expect_square(
        load("b.obj", "v \\\n0 0 0\nv 1\\\n 0 0 # \\\nv 1 \\ \t\n1 \\\r\n0.5\nv\\\n\t0 1 0\nf 1 2\\\n\\\n 3\\\n\t4"));
    EXPECT_EQ(load("c.obj", square_obj + "f 1 2 \\\n3 # \\\nv 9 9 9\n").vertex_count(), 5u);
    expect_square(load("d.obj", square_obj.substr(0, square_obj.size() - 1) + " \\"));
}

TEST_F(Dialects, OfObjHoldWhatIsNoSurface) {
    expect_square(
        load("a.obj",
             "# colours and weights\nmtllib none.mtl\no a b\ng\ns 1\nv 0 0 0 1 0.5 0.25\nv 1 0 0 1.0\nv 1 1 0.5 1 1 "
             "1 1\nv 0 1 0\nvt 0 0\nvt 1 1 0\nvn 0 0 1\nvp 0.5\ncstype bezier\ndeg 3\ncurv 0 1 1 2\nparm u 0 1\nend\n"
             "p 1 2\nl 1/1 2/1\ncurv2 1 2\nlod 3\nusemtl red\ns off\nf -4/-2/-1 -3/-2 -2//-1 -1\nmg 0\n"));
    expect_square(load("b.obj", "v 0 0 0\nv 1e0 0.0E+0 0\nv +1. 1 .5\nv 0 1 -0e9\nf 1/ 2// 3/1/ 4//1\n"));
}

TEST_F(Dialects, OfObjMixPolygonsOfNegativeIndices) {
    const LoadedMesh mesh =
        load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1\nv 2 0 0\nf -4 -1 -3\nf 1 -1 2\n");
    EXPECT_EQ(mesh.face_of_triangle, (Indices{0, 0, 1, 2}));
    EXPECT_EQ(Indices(mesh.indices.begin() + 6, mesh.indices.end()), (Indices{1, 4, 2, 0, 4, 1}));
}

TEST_F(Dialects, OfOffHaveManyKeywords) {
    const std::string corners[] = {"0 0 0", "1 0 0", "1 1 0.5", "0 1 0"};
    const auto file = [&](const std::string& keyword, const std::string& more) {
        std::string text = keyword + "\n4 1 0\n";
        for (const std::string& corner : corners) text += corner + more + "\n";
        return text + "4 0 1 2 3\n";
    };
    for (const char* start : {"", "# by hand\n", "\n# by hand\n\n"}) {
        for (const auto& [keyword, more] :
             std::vector<std::pair<std::string, std::string>>{{"OFF", ""},
                                                              {"off", ""},
                                                              {"OFF # and a comment", ""},
                                                              {"OFF", " 255 0 0 255"},
                                                              {"COFF", " 255 0 0 255"},
                                                              {"COFF", " 0.5 0.5 0.5"},
                                                              {"COFF", " 7"},
                                                              {"COFF", ""},
                                                              {"coff", " 1 2 3"},
                                                              {"NOFF", " 0 0 1"},
                                                              {"NCOFF", " 0 0 1 255 0 0 255"},
                                                              {"CNOFF", " 0 0 1 255 0 0 255"},
                                                              {"STOFF", " 0 1"},
                                                              {"STCNOFF", " 0 0 1 255 0 0 255 0.5 0.5"},
                                                              {"nOFF\n3", ""},
                                                              {"nOFF 3", ""},
                                                              {"CnOFF 3", " 1 2 3"}}) {
            SCOPED_TRACE(start + keyword);
            expect_square(load("a.off", start + file(keyword, more)));
        }
    }
}

TEST_F(Dialects, OfOffWriteCountsInManyPlaces) {
    const std::string rest = square_off.substr(square_off.find("0 0 0"));
    for (const char* start : {"OFF4 1 0\n", "OFF 4 1 0\n", "OFF4\n1 0\n", "OFF\n4\n1\n", "OFF 4\n1 0\n", "OFF\n4 1\n",
                              "OFF\n# counts\n4 1 0 # 0 edges\n", "OFF\n+4 1 -1\n", "COFF4 1 0\n", "OFF\t4\t1\t0\n"}) {
        SCOPED_TRACE(start);
        expect_square(load("a.off", start + rest));
    }
    expect_square(load("a.off", "OFF\n4 1 4\n" + rest + "# and edges, or what else there is\n2 0 1\n"));
    expect_square(load("a.off", "OFF\n4 1 0\n0 0 0 # a\n\n1 0 0\n# b\n1 1 0.5\n0 1 0\n4 0 1 2 3 0.5 0.5 0.5 # c"));
}

TEST_F(Dialects, OfPlyWriteTheirHeadersFreely) {
    const auto with = [](const std::string& from, const std::string& to) {
        std::string ply = square_ply;
        ply.replace(ply.find(from), from.size(), to);
        return ply;
    };
    expect_square(load("a.ply", with("ply\n", "ply \n")));
    expect_square(load("a.ply", with("ply\n", "PLY\t\n")));
    expect_square(load("a.ply", with("ply\n", "ply\ncomment before the format\nobj_info 1\n\n")));
    expect_square(load("a.ply", with("end_header", "comment at the end\nobj_info\nEND_HEADER ")));
    expect_square(load("a.ply", with("property float y", "Property  FLOAT\ty ")));
    expect_square(load("a.ply", with("element vertex", "comment ends in \\\nelement vertex")));
    expect_square(load("a.ply", with("format ascii 1.0", "FORMAT ASCII 1.0")));
    expect_square(load("a.ply", with("vertex_indices", "vertex_index")));
    expect_square(load("a.ply", with("list uchar int", "list int64 uint64")));
}

TEST_F(Dialects, OfPlyListAnythingBesideTheCorners) {
    expect_square(load(
        "a.ply",
        "ply\nformat ascii 1.0\nelement material 1\nproperty list uchar uchar name\nelement vertex 4\n"
        "property list uchar double weights\nproperty float x\nproperty float y\nproperty float z\nproperty int64 id\n"
        "property uchar red\nelement face 1\nproperty list uint float uv\nproperty list uchar int vertex_indices\n"
        "property list uchar float more\nelement edge 2\nproperty int a\nend_header\n"
        "3 1 2 3\n0 0 0 0 -9223372036854775808 1\n1 0.5 1 0 0 2 1\n2 1 1 1 1 0.5 3 1\n0 0 1 0 4 1\n"
        "2 0.5 1e5 4 0 1 2 3 0\n5\n6\n"));
}

TEST_F(Dialects, OfAsciiPlyHoldMoreThanTheHeaderTellsOrBreakTheirLinesAnywhere) {
    const std::string header = square_ply.substr(0, square_ply.find("0 0 0\n"));
    expect_square(load("a.ply", header + "0 0 0 9 9\n1 0 0\n\n1 1 0.5 3 1 2 3\n0 1 0 7\n4 0 1 2 3 2 0 0\n"));
    expect_square(load("a.ply", header + "0 0 0 1 0 0\n1 1 0.5\n0 1\n0 4 0\n1\n2 3"));
    expect_square(load("a.ply", header + "0 0 0 1 0 0 1 1 0.5 0 1 0 4 0 1 2 3"));
}

TEST_F(Dialects, OfAsciiStlAreWrittenFreely) {
    expect_facet(load("a.stl",
                      "solid a b facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0.5 endloop "
                      "endfacet endsolid a b"));
    expect_facet(load("b.stl",
                      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0.5\nend loop\n"
                      "end facet\nend solid\n"));
    expect_facet(load("c.stl",
                      "solid facet\nFacet Normal nan nan -nan(ind)\n  Outer Loop\nVertex 0 0 0\nVertex 1 0 0\nVertex "
                      "1.0e+000 1 5.0e-001\n EndLoop\nEndFacet\nEnd Solid facet"));
    expect_facet(
        load("d.stl",
             "solid no normals\nfacet normal\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0.5\nendloop\n"
             "endfacet\nendsolid no normals\n\n\n"));
    EXPECT_EQ(load("e.stl",
                   "solid a facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0.5 endloop "
                   "endfacet endsolid a solid b facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0.5 "
                   "endloop endfacet endsolid b")
                  .face_count,
              2u);
    EXPECT_EQ(load("f.stl", facet_stl + "\n" + facet_stl + facet_stl).face_count, 3u);
}

std::string counting(std::string stl, std::uint32_t count) {
    std::memcpy(stl.data() + 80, &count, sizeof count);
    return stl;
}

TEST_F(Dialects, OfBinaryStlCountFacetsWrongly) {
    const std::vector<float> facet = {0, 0, 0, 1, 0, 0, 1, 1, 0.5f};
    for (const char* head : {"made by hand", "solid but binary", "COLOR=\xFF\x80\x01\xFF"}) {
        const std::string three = binary_stl({facet, facet, facet}, head);
        SCOPED_TRACE(head);
        EXPECT_EQ(load("a.stl", counting(three, 0)).face_count, 3u);
        EXPECT_EQ(load("a.stl", counting(three, 2)).face_count, 3u);
        EXPECT_EQ(load("a.stl", three + "\n").face_count, 3u);
        EXPECT_EQ(load("a.stl", three + std::string(49, '\0')).face_count, 3u);
        // What bytes are missing of is not known.
        for (const std::uint32_t count : {4u, 0x80000000u, 0xFFFFFFFFu}) {
            expect_error("a.stl", counting(three, count), Status::ERROR_FILE_FORMAT,
                         std::to_string(count) + " facets would take");
        }
        expect_error("a.stl", counting(three, 0) + "\n", Status::ERROR_FILE_FORMAT,
                     "0 facets would take 84 bytes, it has 235");
        expect_error("a.stl", three + std::string(51, '\0'), Status::ERROR_FILE_FORMAT, "(byte 80");
    }
}

TEST_F(Dialects, OfBinaryStlHoldColoursAndPayloads) {
    const std::vector<float> facet = {0, 0, 0, 1, 0, 0, 1, 1, 0.5f};
    const std::string two = binary_stl({facet, {5, 5, 5, 6, 5, 5, 6, 6, 5}});
    std::string coloured = two;
    coloured[84 + 48] = '\x1F';
    coloured[84 + 49] = '\x80';
    EXPECT_EQ(load("a.stl", coloured).face_count, 2u);
    // The two bytes count what follows them.
    std::string with_payload = two;
    with_payload[84 + 98] = 3;
    with_payload[84 + 48] = 7;
    with_payload.insert(84 + 50, 7, 'x');
    with_payload += "abc";
    const LoadedMesh mesh = load("b.stl", with_payload);
    EXPECT_EQ(mesh.face_count, 2u);
    EXPECT_EQ(floats(mesh).at(9), 5.0f);
}

} // namespace
} // namespace raywise
