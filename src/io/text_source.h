// The text of a mesh file, line by line or word by word, whatever ends its lines; and the one way to say where in it something
// is wrong.
#pragma once

#include "base/error.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace raywise::io {

// A word of the file as a message may show it: not too long, and, since messages go to terminals, nothing but printable
// ASCII.
std::string quoted(std::string_view word);

// Whether they are the same but for upper and lower case.
bool is_word(std::string_view word, std::string_view lower_case);

// The line without the comment that # begins. Not so in 1.#IND and 1.#INF, which are what some programs write for NaN and
// infinity.
std::string_view without_comment(std::string_view line);

// The file without a UTF-8 byte order mark. Throws Error(ERROR_FILE_FORMAT) for text in UTF-16 or UTF-32.
std::string_view without_byte_order_mark(std::string_view bytes);

// Lines end with LF, CRLF or CR, and may do so differently within one file.
class TextSource {
public:
    // `text` has no byte order mark; zero bytes at its end are padding. Throws Error(ERROR_FILE_FORMAT) when it holds others:
    // it is no text then. first_line: the number of its first line.
    explicit TextSource(std::string_view text, std::uint64_t first_line = 1);

    // The next line, without its end. False at the end of the text.
    bool take_line(std::string_view& line);
    // How many lines from here on are not blank.
    std::uint64_t count_rows() const;
    // The next word of this or a later line; empty at the end of the text.
    std::string_view take_word();
    // The next word, if there is one before the line ends.
    std::string_view take_word_of_line();
    // The same, without taking it.
    std::string_view peek_word_of_line() const;

    // The line that what was taken last began on, from 1.
    std::uint64_t line() const { return taken_line_; }
    // Throws Error with the reason and the line.
    [[noreturn]] void fail(Status status, const std::string& reason) const;

private:
    void skip_line_end();
    std::string_view take_word_here();

    std::string_view text_;
    std::size_t position_ = 0;
    std::uint64_t line_;       // at position_
    std::uint64_t taken_line_; // of what was taken last
    // Where the next of each stands, so that no part of a text without them is searched twice.
    struct Mark {
        char character;
        std::size_t position;
    };
    std::array<Mark, 2> ends_{{{'\n', 0}, {'\r', 0}}};
};

} // namespace raywise::io
