// contract_report: puts the parts that the programs of a desk target wrote together into its report.
#include "contract/report_json.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
    using namespace raywise::sweep;
    CLI::App app("Puts the parts of a desk target's report together.");
    app.name("contract_report");
    ReportHead head;
    std::vector<std::string> parts;
    std::string output;
    app.add_option("--target", head.target, "name of the make target")->required()->type_name("NAME");
    app.add_option("--commit", head.commit, "what was measured")->required()->type_name("COMMIT");
    app.add_option("--command", head.command, "what was typed")->required()->type_name("TEXT");
    app.add_option("--output,-o", output, "write the report here")->required()->type_name("FILE");
    app.add_option("parts", parts, "JSON files with rows and a summary")->required()->type_name("FILE...");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        head.machine = machine_text();
        head.date = date_text();
        std::vector<Json> read;
        for (const std::string& part : parts) read.push_back(read_json(part));
        const Json report = merged_report(head, read);
        write_json(output, report);
        std::printf("%s\n", report.at("summary").dump(2).c_str());
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "contract_report: %s\n", error.what());
        return 1;
    }
}
