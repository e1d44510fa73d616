#include "io/coordinates.h"
#include "io/file_mesh.h"

#include "base/words.h"

#include <algorithm>

namespace raywise::io {
namespace {

// What stands before OFF says what each vertex has beside its place: texture coordinates, a normal, or a colour of any length,
// none included.
constexpr struct {
    std::string_view word;
    int numbers; // at least
} known_prefixes[] = {{"st", 2}, {"c", 0}, {"n", 3}};

class OffReader {
public:
    explicit OffReader(std::string_view text) : source_(text) {}

    FileMesh read() {
        words_ = row("the counts are missing");
        keyword();
        const std::uint64_t vertices = count("vertices");
        const std::uint64_t faces = count("faces");
        const std::string_view edges = take_word(words_); // nobody needs them, and some files leave them out
        if (!edges.empty() && !number_of<std::int64_t>(edges)) {
            source_.fail(Status::ERROR_FILE_FORMAT,
                         "three counts have to follow OFF, and " + quoted(edges) + " is none");
        }
        for (std::uint64_t i = 0; i < vertices; ++i) {
            words_ = row(missing("vertex", i, vertices));
            vertex();
        }
        for (std::uint64_t i = 0; i < faces; ++i) {
            words_ = row(missing("face", i, faces));
            face();
        }
        return std::move(mesh_);
    }

private:
    static std::string missing(const char* element, std::uint64_t number, std::uint64_t all) {
        return std::string(element) + " " + std::to_string(number) + " of " + std::to_string(all) + " is missing";
    }

    // The next line that is not blank, without its comment.
    std::string_view row(const std::string& what_is_missing) {
        for (std::string_view line; source_.take_line(line);) {
            line = without_comment(line);
            std::string_view words = line;
            if (!take_word(words).empty()) return line;
        }
        source_.fail(Status::ERROR_FILE_FORMAT, "the file is truncated: " + what_is_missing);
    }

    // [ST][C][N]OFF, in any order, as one word with the first count too; or nOFF and the number of dimensions.
    void keyword() {
        const std::string_view word = take_word(words_);
        std::string_view rest = word;
        bool has_dimension = false;
        while (!is_word(rest.substr(0, 3), "off")) {
            has_dimension = rest.substr(0, 4) == "nOFF"; // in this one word upper and lower case differ
            if (has_dimension) break;
            const auto* prefix = std::find_if(
                std::begin(known_prefixes), std::end(known_prefixes),
                [rest](const auto& known) { return is_word(rest.substr(0, known.word.size()), known.word); });
            if (prefix == std::end(known_prefixes)) break;
            rest.remove_prefix(prefix->word.size());
            more_numbers_ += prefix->numbers;
        }
        if (has_dimension) rest.remove_prefix(1);
        if (rest.substr(0, 4) == "4OFF" || rest.substr(0, 5) == "4nOFF") fail_dimensions();
        if (!is_word(rest.substr(0, 3), "off"))
            source_.fail(Status::ERROR_FILE_FORMAT, "the file does not begin with OFF");
        rest.remove_prefix(3);
        // As in OFF4 1 0, which ModelNet40 is full of: the count is the next word.
        if (!rest.empty()) {
            if (!number_of<std::uint64_t>(rest)) {
                source_.fail(Status::ERROR_FILE_FORMAT, quoted(word) + " is no keyword of an OFF file");
            }
            words_ = {rest.data(), static_cast<std::size_t>(words_.data() + words_.size() - rest.data())};
        }
        if (has_dimension && number_of<std::uint64_t>(count_word()) != std::uint64_t{3}) fail_dimensions();
    }

    [[noreturn]] void fail_dimensions() const {
        source_.fail(Status::ERROR_FILE_FORMAT, "OFF files of other than 3 dimensions are not supported");
    }

    // Counts may stand on the keyword's line, on the next, or on one each.
    std::string_view count_word() {
        std::string_view word = take_word(words_);
        if (!word.empty()) return word;
        words_ = row("the counts are missing");
        return take_word(words_);
    }

    std::uint64_t count(const char* elements) {
        const std::string_view word = count_word();
        const auto value = number_of<std::uint64_t>(word);
        if (!value) {
            source_.fail(Status::ERROR_FILE_FORMAT,
                         std::string("the number of ") + elements + " is missing: " + quoted(word) + " is none");
        }
        if (*value > most_elements) source_.fail(Status::ERROR_TOO_MANY, too_many(elements));
        return *value;
    }

    // The place comes first; what the keyword announces, and colours that it does not, follow.
    void vertex() {
        std::array<double, 3> position{};
        for (double& x : position) x = coordinate64(source_, take_word(words_), "vertex", mesh_.vertex_count());
        for (int i = 0; i < more_numbers_; ++i) {
            if (!take_word(words_).empty()) continue;
            source_.fail(Status::ERROR_FILE_FORMAT, "vertex " + std::to_string(mesh_.vertex_count()) + " has " +
                                                        std::to_string(3 + i) + " numbers, the keyword announces " +
                                                        std::to_string(3 + more_numbers_));
        }
        mesh_.add_vertex(position);
    }

    // The number of corners, the corners, and colours.
    void face() {
        const std::uint64_t number = mesh_.face_count();
        const auto corners = number_of<std::uint64_t>(take_word(words_));
        if (!corners) fail_face(number, "the number of corners is missing");
        if (*corners < 3)
            source_.fail(Status::ERROR_BAD_POLYGON, bad_polygon(number, static_cast<std::int64_t>(*corners)));
        if (*corners > most_elements) source_.fail(Status::ERROR_TOO_MANY, too_many("corners"));
        mesh_.begin_face(static_cast<std::uint32_t>(*corners));
        for (std::uint64_t i = 0; i < *corners; ++i) {
            const std::string_view word = take_word(words_);
            const auto index = number_of<std::int64_t>(word);
            if (!index) fail_face(number, word.empty() ? "it has too few corners" : quoted(word) + " is no index");
            if (*index < 0 || static_cast<std::uint64_t>(*index) >= mesh_.vertex_count()) {
                source_.fail(Status::ERROR_INDEX_OUT_OF_RANGE,
                             bad_index(number, std::to_string(*index), mesh_.vertex_count()));
            }
            mesh_.add_corner(static_cast<std::uint32_t>(*index));
        }
    }

    [[noreturn]] void fail_face(std::uint64_t number, const std::string& what) const {
        source_.fail(Status::ERROR_FILE_FORMAT, "face " + std::to_string(number) + ": " + what);
    }

    TextSource source_;
    FileMesh mesh_;
    std::string_view words_; // of the current row
    int more_numbers_ = 0;   // of each vertex, behind its place
};

// Looked for first: what follows it is no text.
bool is_binary(std::string_view text) {
    std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    const std::string_view keyword = take_word(line);
    return keyword.size() >= 3 && is_word(keyword.substr(keyword.size() - 3), "off") &&
           is_word(take_word(line), "binary");
}

} // namespace

FileMesh read_off(std::string_view bytes) {
    const std::string_view text = without_byte_order_mark(bytes);
    if (is_binary(text)) throw Error(Status::ERROR_FILE_FORMAT, "binary OFF files are not supported (line 1)");
    return OffReader(text).read();
}

} // namespace raywise::io
