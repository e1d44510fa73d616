// JSON written from front to back, indented by two blanks. A tree is never built; see json_tree.h.
#pragma once

#include "model/json_tree.h"

#include <cstdint>
#include <string>

namespace raywise {

class JsonWriter {
public:
    // name: of the member; empty inside a list and for the whole.
    void open_object(const char* name = "") { open(name, '{'); }
    void open_list(const char* name = "") { open(name, '['); }
    void close_object() { close('}'); }
    void close_list() { close(']'); }

    void put(const char* name, double value) { put_raw(name, json_number(value)); } // null for NaN and infinities
    void put(const char* name, std::uint64_t value) { put_raw(name, std::to_string(value)); }
    void put(const char* name, std::uint32_t value) { put_raw(name, std::to_string(value)); }
    void put(const char* name, int value) { put_raw(name, std::to_string(value)); }
    void put(const char* name, bool value) { put_raw(name, value ? "true" : "false"); }
    void put(const char* name, const std::string& value) { put_raw(name, json_text(value)); }
    void put(const char* name, const char* value) { put_raw(name, json_text(value)); }
    void put_null(const char* name) { put_raw(name, "null"); }

    // The text so far, with a line's end.
    std::string finish() { return text_ + "\n"; }

private:
    void open(const char* name, char bracket);
    void close(char bracket);
    void put_raw(const char* name, const std::string& value);
    void begin_line();

    std::string text_;
    int depth_ = 0;
    bool empty_ = true; // nothing in the innermost object or list yet
};

} // namespace raywise
