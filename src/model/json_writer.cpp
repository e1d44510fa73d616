#include "model/json_writer.h"

namespace raywise {

void JsonWriter::begin_line() {
    if (depth_ == 0) return;
    text_ += empty_ ? "\n" : ",\n";
    text_.append(2 * static_cast<std::size_t>(depth_), ' ');
    empty_ = false;
}

void JsonWriter::put_raw(const char* name, const std::string& value) {
    begin_line();
    if (*name != '\0') text_ += json_text(name) + ": ";
    text_ += value;
}

void JsonWriter::open(const char* name, char bracket) {
    put_raw(name, std::string(1, bracket));
    ++depth_;
    empty_ = true;
}

void JsonWriter::close(char bracket) {
    --depth_;
    if (!empty_) {
        text_ += "\n";
        text_.append(2 * static_cast<std::size_t>(depth_), ' ');
    }
    text_ += bracket;
    empty_ = false;
}

} // namespace raywise
