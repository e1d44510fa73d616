#include "io/expected.h"
#include "io/words.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace raywise::io {
namespace {

[[noreturn]] void fail(const std::string& text) { throw Error(Status::ERROR_FILE_FORMAT, text); }

struct Type {
    unsigned size = 0;
    bool is_float = false;
    bool is_signed = false;
};

Type type_named(std::string_view name) {
    if (name == "char" || name == "int8") return {1, false, true};
    if (name == "uchar" || name == "uint8") return {1, false, false};
    if (name == "short" || name == "int16") return {2, false, true};
    if (name == "ushort" || name == "uint16") return {2, false, false};
    if (name == "int" || name == "int32") return {4, false, true};
    if (name == "uint" || name == "uint32") return {4, false, false};
    if (name == "float" || name == "float32") return {4, true, true};
    if (name == "double" || name == "float64") return {8, true, true};
    fail("the header names an unknown type: " + quoted(name));
}

struct Property {
    Type type;
    Type count; // size 0: not a list
    std::string type_name;
    int axis = -1;           // of a vertex coordinate
    bool is_corners = false; // of a face
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

enum class Encoding {
    ascii,
    little,
    big
};

struct Header {
    Encoding encoding = Encoding::ascii;
    std::vector<Element> elements;
    std::size_t size = 0;
};

Property property_of(std::string_view words, const Element& element) {
    Property property;
    std::string_view word = take_word(words);
    if (word == "list") {
        property.count = type_named(take_word(words));
        if (property.count.is_float) fail("the header counts a list with floats");
        word = take_word(words);
    }
    property.type = type_named(word);
    property.type_name = word;
    const std::string_view name = take_word(words);
    if (name.empty()) fail("the header holds a property without a name");
    const bool is_list = property.count.size > 0;
    if (element.name == "vertex" && !is_list && name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
        property.axis = name[0] - 'x';
        if (!property.type.is_float) fail("vertex coordinates have to be float or double");
    }
    if ((element.name == "face" || element.name == "tristrips") && is_list &&
        (name == "vertex_indices" || name == "vertex_index")) {
        property.is_corners = true;
        if (property.type.is_float) fail("vertex indices have to be integers");
    }
    return property;
}

Header header_of(std::string_view text) {
    Header header;
    std::string_view rest = text;
    const auto line = [&rest] {
        if (rest.empty()) fail("the file is truncated: the header has no end");
        std::string_view next = take_line(rest);
        if (!next.empty() && next.back() == '\r') next.remove_suffix(1);
        return next;
    };
    const std::string_view magic = line();
    if (magic != "ply" && magic != "PLY") fail("the file does not begin with ply");
    bool has_format = false;
    for (std::string_view words = line();; words = line()) {
        const std::string_view keyword = take_word(words);
        if (keyword == "end_header") break;
        if (keyword == "format") {
            const std::string_view format = take_word(words);
            has_format = true;
            if (format == "ascii")
                header.encoding = Encoding::ascii;
            else if (format == "binary_little_endian")
                header.encoding = Encoding::little;
            else if (format == "binary_big_endian")
                header.encoding = Encoding::big;
            else
                fail("the header names an unknown format: " + quoted(format));
        } else if (keyword == "element") {
            Element element;
            element.name = take_word(words);
            const auto count = number_of<std::uint64_t>(take_word(words));
            if (!count) fail("the header does not say how many of element " + quoted(element.name) + " there are");
            element.count = *count;
            header.elements.push_back(std::move(element));
        } else if (keyword == "property") {
            if (header.elements.empty()) fail("the header holds a property before the first element");
            header.elements.back().properties.push_back(property_of(words, header.elements.back()));
        } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
            fail("the header holds an unknown word: " + quoted(keyword));
        }
    }
    if (!has_format) fail("the header does not name the format");
    header.size = text.size() - rest.size();
    return header;
}

// The two ways values are written. A value is handed out as the bytes it has in the file.
class Values {
public:
    Values(std::string_view body, Encoding encoding) : rest_(body), encoding_(encoding) {}

    std::string_view take(const Type& type) {
        if (encoding_ == Encoding::ascii) {
            const std::string_view word = take_word(rest_);
            if (word.empty()) fail_truncated();
            return word;
        }
        if (rest_.size() < type.size) fail_truncated();
        const std::string_view bytes = rest_.substr(0, type.size);
        rest_.remove_prefix(type.size);
        return bytes;
    }

    std::int64_t take_integer(const Type& type, const char* element, std::uint64_t number_of_element) {
        const std::string_view value = take(type);
        if (encoding_ == Encoding::ascii) {
            const auto number = number_of<std::int64_t>(value);
            if (!number)
                fail(std::string(element) + " " + std::to_string(number_of_element) + ": " + quoted(value) +
                     " is no integer");
            return *number;
        }
        std::uint64_t number = 0;
        for (unsigned i = 0; i < type.size; ++i) {
            const std::size_t at = encoding_ == Encoding::little ? type.size - 1 - i : i;
            number = number << 8 | static_cast<unsigned char>(value[at]);
        }
        const std::uint64_t sign = std::uint64_t{1} << (8 * type.size - 1);
        if (type.is_signed && (number & sign) != 0)
            return static_cast<std::int64_t>(number) - static_cast<std::int64_t>(2 * sign);
        return static_cast<std::int64_t>(number);
    }

    void skip(const Property& property, const char* element, std::uint64_t number) {
        if (property.count.size == 0) {
            take(property.type);
            return;
        }
        const std::int64_t count = take_integer(property.count, element, number);
        if (count < 0) fail(std::string(element) + " " + std::to_string(number) + ": a list of negative length");
        for (std::int64_t i = 0; i < count; ++i) take(property.type);
    }

private:
    [[noreturn]] static void fail_truncated() { fail("the file is truncated"); }

    std::string_view rest_;
    Encoding encoding_;
};

class PlyRewrite {
public:
    explicit PlyRewrite(const std::string& text)
        : header_(header_of(text)), values_(std::string_view(text).substr(header_.size), header_.encoding) {}

    Expected run(std::string& out) {
        if (header_.encoding == Encoding::ascii) ascii_ = true;
        const Element* vertex = find("vertex");
        const Element* face = find("face");
        const Element* strips = find("tristrips");
        if (vertex == nullptr) fail("the header has no element vertex");
        if (face == nullptr || face->count == 0) face = strips;
        if (face == nullptr || face->count == 0) fail_no_faces();
        if (vertex->count > most_elements) fail_too_many("vertices");
        if (face->count > most_elements) fail_too_many("faces");
        expected_.vertices = vertex->count;
        std::array<int, 3> axes{};
        for (const Property& property : vertex->properties) {
            if (property.axis >= 0) ++axes[static_cast<std::size_t>(property.axis)];
        }
        if (axes != std::array<int, 3>{1, 1, 1}) fail("element vertex needs the properties x, y and z, once each");
        if (std::count_if(face->properties.begin(), face->properties.end(),
                          [](const Property& p) { return p.is_corners; }) != 1) {
            fail("element " + face->name + " needs one list of vertex indices");
        }

        bool has_vertices = false;
        bool has_faces = false;
        for (const Element& element : header_.elements) {
            if (has_vertices && has_faces) break; // nothing behind them is wanted
            if (&element == vertex) {
                vertices(element);
                has_vertices = true;
            } else if (&element == face) {
                faces(element, face == strips);
                has_faces = true;
            } else {
                skip(element);
            }
        }
        if (expected_.faces == 0) fail_no_faces();
        out = new_header(*vertex) + vertex_rows_ + face_rows_;
        return expected_;
    }

private:
    const Element* find(std::string_view name) const {
        const Element* found = nullptr;
        for (const Element& element : header_.elements) {
            if (element.name != name) continue;
            if (found != nullptr) fail("the header has two elements " + std::string(name));
            found = &element;
        }
        return found;
    }

    void vertices(const Element& element) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const Property& property : element.properties) {
                if (property.axis < 0) {
                    values_.skip(property, "vertex", i);
                    continue;
                }
                const std::string_view value = values_.take(property.type);
                if (ascii_) check_coordinate(value, [i] { return "vertex " + std::to_string(i); });
                vertex_rows_ += value;
                if (ascii_) vertex_rows_ += ' ';
            }
            if (ascii_) vertex_rows_.back() = '\n';
        }
    }

    void faces(const Element& element, bool are_strips) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const Property& property : element.properties) {
                if (!property.is_corners) {
                    values_.skip(property, "face", i);
                } else if (are_strips) {
                    strip(property, i);
                } else {
                    face(property, i);
                }
            }
        }
    }

    void face(const Property& property, std::uint64_t number) {
        const std::int64_t count = values_.take_integer(property.count, "face", number);
        if (count < 3) fail_bad_polygon(number, static_cast<std::uint64_t>(std::max<std::int64_t>(count, 0)));
        put(count);
        for (std::int64_t corner = 0; corner < count; ++corner) put(take_index(property, number));
        end_face();
    }

    // Triangle strips, as the Stanford scans have them: each index makes a triangle with the two before it, every
    // other one the other way round, and -1 begins anew. Each triangle becomes a face.
    void strip(const Property& property, std::uint64_t number) {
        const std::int64_t count = values_.take_integer(property.count, "tristrips", number);
        std::array<std::int64_t, 2> last{};
        std::uint64_t length = 0;
        for (std::int64_t i = 0; i < count; ++i) {
            const std::int64_t index = values_.take_integer(property.type, "tristrips", number);
            if (index == -1) {
                length = 0;
                continue;
            }
            check_index(index, expected_.faces);
            if (length >= 2) {
                if (expected_.faces >= most_elements) fail_too_many("faces");
                put(3);
                put(last[length % 2 == 0 ? 0 : 1]);
                put(last[length % 2 == 0 ? 1 : 0]);
                put(index);
                end_face();
            }
            last = {last[1], index};
            ++length;
        }
    }

    std::int64_t take_index(const Property& property, std::uint64_t face_number) {
        const std::int64_t index = values_.take_integer(property.type, "face", face_number);
        check_index(index, face_number);
        return index;
    }

    void check_index(std::int64_t index, std::uint64_t face_number) const {
        if (index >= 0 && static_cast<std::uint64_t>(index) < expected_.vertices) return;
        fail_index(face_number, std::to_string(index), expected_.vertices);
    }

    void end_face() {
        if (ascii_) face_rows_.back() = '\n';
        ++expected_.faces;
    }

    void skip(const Element& element) {
        if (element.properties.empty()) return;
        const std::string name = quoted(element.name);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const Property& property : element.properties) values_.skip(property, name.c_str(), i);
        }
    }

    // As int, in the byte order of the file.
    void put(std::int64_t number) {
        if (ascii_) {
            face_rows_ += std::to_string(number);
            face_rows_ += ' ';
            return;
        }
        for (int i = 0; i < 4; ++i) {
            const int shift = header_.encoding == Encoding::little ? 8 * i : 24 - 8 * i;
            face_rows_ += static_cast<char>(static_cast<unsigned char>(number >> shift & 0xFF));
        }
    }

    std::string new_header(const Element& vertex) const {
        std::string text = "ply\nformat ";
        text += ascii_ ? "ascii" : header_.encoding == Encoding::little ? "binary_little_endian" : "binary_big_endian";
        text += " 1.0\nelement vertex " + std::to_string(expected_.vertices) + "\n";
        for (const Property& property : vertex.properties) {
            if (property.axis >= 0) text += "property " + property.type_name + " " + "xyz"[property.axis] + "\n";
        }
        return text + "element face " + std::to_string(expected_.faces) +
               "\nproperty list int int vertex_indices\nend_header\n";
    }

    Header header_;
    Values values_;
    bool ascii_ = false;
    Expected expected_;
    std::string vertex_rows_;
    std::string face_rows_;
};

} // namespace

Expected prepare_ply(std::string& text) {
    std::string rewritten;
    const Expected expected = PlyRewrite(text).run(rewritten);
    text = std::move(rewritten);
    return expected;
}

} // namespace raywise::io
