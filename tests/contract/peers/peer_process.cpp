#include "contract/peers/peer_process.h"

#include "contract/peers/protocol.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace raywise::contract {

class PeerProcess::Connection {
public:
    Connection(const std::vector<std::string>& command, const ProcessLimits& limits, const std::string& log)
        : child_(command, log, limits.most_memory), patience_(limits.patience) {}

    // The body of the reply.
    std::string ask(Request request, const Packer& body) {
        try {
            return exchange(request, body);
        } catch (const ChildLost&) {
            lost_ = true;
            throw;
        }
    }

    bool lost() const { return lost_; }

private:
    std::string exchange(Request request, const Packer& body) {
        const auto deadline = std::chrono::steady_clock::now() + patience_;
        MessageHead head{static_cast<std::uint32_t>(request), static_cast<std::uint32_t>(body.bytes().size())};
        child_.write(&head, sizeof head, deadline);
        child_.write(body.bytes().data(), body.bytes().size(), deadline);
        child_.read(&head, sizeof head, deadline);
        std::string reply(head.bytes, '\0');
        child_.read(reply.data(), reply.size(), deadline);
        if (static_cast<Reply>(head.kind) != Reply::ok) raise(static_cast<Reply>(head.kind), Unpacker(reply).text());
        return reply;
    }

    [[noreturn]] static void raise(Reply kind, const std::string& text) {
        if (kind == Reply::inexpressible) throw Inexpressible(text);
        const std::size_t end = text.find('\n');
        if (kind == Reply::refusal && end != std::string::npos)
            throw Refusal(text.substr(0, end), text.substr(end + 1));
        throw PeerFailure("error: " + text);
    }

    ChildProcess child_;
    std::chrono::milliseconds patience_;
    bool lost_ = false;
};

namespace {

class PeerScene : public Scene {
public:
    explicit PeerScene(std::shared_ptr<PeerProcess::Connection> connection) : connection_(std::move(connection)) {}

    Answer closest(const Ray& ray) override {
        ask(Request::closest, ray);
        return Unpacker(reply_).answer();
    }

    bool any(const Ray& ray) override {
        ask(Request::any, ray);
        return Unpacker(reply_).get<std::uint32_t>() != 0;
    }

    void all(const Ray& ray, std::vector<Answer>& answers) override {
        ask(Request::all, ray);
        read(answers);
    }

    void closest_batch(const std::vector<Ray>& rays, std::vector<Answer>& answers) override {
        Packer body;
        for (const Ray& ray : rays) body.put(ray);
        reply_ = connection_->ask(Request::closest_batch, body);
        read(answers);
    }

private:
    void ask(Request request, const Ray& ray) {
        Packer body;
        body.put(ray);
        reply_ = connection_->ask(request, body);
    }

    void read(std::vector<Answer>& answers) {
        answers.clear();
        Unpacker reply(reply_);
        while (!reply.done()) answers.push_back(reply.answer());
    }

    std::shared_ptr<PeerProcess::Connection> connection_;
    std::string reply_;
};

} // namespace

PeerProcess::PeerProcess(std::vector<std::string> command, ProcessLimits limits, std::string log)
    : command_(std::move(command)), limits_(limits), log_(std::move(log)), connection_(connect()) {
    const std::string reply = connection_->ask(Request::describe, Packer());
    const auto told = nlohmann::json::parse(reply);
    name_ = told.at("name").get<std::string>();
    version_ = told.at("version").get<std::string>();
    capabilities_.has_any = told.at("has_any").get<bool>();
    capabilities_.has_all = told.at("has_all").get<bool>();
    capabilities_.has_batch = told.at("has_batch").get<bool>();
    capabilities_.refuses_bad_meshes = told.at("refuses_bad_meshes").get<bool>();
    capabilities_.many_geometries = told.at("many_geometries").get<bool>();
    capabilities_.orders_ties = told.at("orders_ties").get<bool>();
    capabilities_.decides_exactly = told.at("decides_exactly").get<bool>();
    capabilities_.counts_crossings = told.at("counts_crossings").get<bool>();
    capabilities_.t_tolerance = told.at("t_tolerance").get<double>();
}

PeerProcess::~PeerProcess() = default;

std::shared_ptr<PeerProcess::Connection> PeerProcess::connect() const {
    return std::make_shared<Connection>(command_, limits_, log_);
}

std::unique_ptr<Scene> PeerProcess::build(const std::vector<Mesh>& meshes) {
    if (connection_->lost()) connection_ = connect();
    Packer body;
    body.put(static_cast<std::uint32_t>(meshes.size()));
    for (const Mesh& mesh : meshes) body.put(mesh);
    connection_->ask(Request::build, body);
    return std::make_unique<PeerScene>(connection_);
}

} // namespace raywise::contract
