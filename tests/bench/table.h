// Text tables for a terminal of 100 columns.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::bench {

class Table {
public:
    // title: a line above; headings: of the columns, the first of which is flush left.
    Table(std::string title, std::vector<std::string> headings);
    void add(std::vector<std::string> cells);
    bool empty() const { return rows_.size() == 1; }
    std::string text() const;

private:
    std::string title_;
    std::vector<std::vector<std::string>> rows_; // headings first
};

// Three digits that count: 0.123, 1.23, 12.3, 123.
std::string digits(double value);
std::string ratio_text(double value); // 1.23
// 69,451
std::string with_commas(std::uint64_t value);

} // namespace raywise::bench
