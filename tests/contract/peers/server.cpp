#include "contract/peers/server.h"

#include "contract/peers/protocol.h"

#include <nlohmann/json.hpp>

#include <cerrno>
#include <system_error>

#include <unistd.h>

namespace raywise::contract {
namespace {

// False at the end of the input, which may only come between two messages.
bool read_fully(int from, void* data, std::size_t bytes) {
    char* to = static_cast<char*>(data);
    std::size_t done = 0;
    while (done < bytes) {
        const ssize_t step = read(from, to + done, bytes - done);
        if (step < 0 && errno == EINTR) continue;
        if (step < 0) throw std::system_error(errno, std::generic_category(), "read");
        if (step == 0 && done > 0) throw std::runtime_error("a message ends too early");
        if (step == 0) return false;
        done += static_cast<std::size_t>(step);
    }
    return true;
}

void write_fully(int to, const void* data, std::size_t bytes) {
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t step = write(to, from, bytes);
        if (step < 0 && errno == EINTR) continue;
        if (step < 0) throw std::system_error(errno, std::generic_category(), "write");
        from += step;
        bytes -= static_cast<std::size_t>(step);
    }
}

std::string description(const Library& library, const std::string& version) {
    const Capabilities has = library.capabilities();
    return nlohmann::json{{"name", library.name()},
                          {"version", version},
                          {"has_any", has.has_any},
                          {"has_all", has.has_all},
                          {"has_batch", has.has_batch},
                          {"refuses_bad_meshes", has.refuses_bad_meshes},
                          {"many_geometries", has.many_geometries},
                          {"orders_ties", has.orders_ties},
                          {"decides_exactly", has.decides_exactly},
                          {"counts_crossings", has.counts_crossings},
                          {"t_tolerance", has.t_tolerance}}
        .dump();
}

class Server {
public:
    Server(Library& library, const std::string& version) : library_(library), version_(version) {}

    // Writes the body of the reply.
    void answer(Request request, Unpacker& body, Packer& reply) {
        std::vector<Answer> answers;
        switch (request) {
            case Request::describe:
                reply.put_text(description(library_, version_));
                return;
            case Request::build:
                build(body);
                return;
            case Request::closest:
                answers = {scene().closest(body.ray())};
                break;
            case Request::any:
                reply.put(std::uint32_t{scene().any(body.ray())});
                return;
            case Request::all:
                scene().all(body.ray(), answers);
                break;
            case Request::closest_batch: {
                std::vector<Ray> rays;
                while (!body.done()) rays.push_back(body.ray());
                scene().closest_batch(rays, answers);
                break;
            }
            default:
                throw std::runtime_error("an unknown request");
        }
        for (const Answer& one : answers) reply.put(one);
    }

private:
    void build(Unpacker& body) {
        scene_.reset(); // it may still be reading the meshes
        meshes_.clear();
        const auto count = body.get<std::uint32_t>();
        for (std::uint32_t i = 0; i < count; ++i) meshes_.push_back(body.mesh());
        scene_ = library_.build(meshes_);
    }

    Scene& scene() {
        if (!scene_) throw std::runtime_error("there is no scene to ask");
        return *scene_;
    }

    Library& library_;
    const std::string& version_;
    std::vector<Mesh> meshes_;
    std::unique_ptr<Scene> scene_;
};

} // namespace

void serve(Library& library, const std::string& version, int from, int to) {
    Server server(library, version);
    MessageHead head;
    while (read_fully(from, &head, sizeof head)) {
        std::string body(head.bytes, '\0');
        if (head.bytes > 0 && !read_fully(from, body.data(), body.size()))
            throw std::runtime_error("a message ends too early");
        Unpacker unpacker(body);
        Packer reply;
        Reply kind = Reply::ok;
        const auto instead = [&](Reply other, const std::string& text) {
            kind = other;
            reply = Packer();
            reply.put_text(text);
        };
        try {
            server.answer(static_cast<Request>(head.kind), unpacker, reply);
        } catch (const Refusal& refusal) {
            instead(Reply::refusal, refusal.kind + "\n" + refusal.what());
        } catch (const Inexpressible& inexpressible) {
            instead(Reply::inexpressible, inexpressible.what());
        } catch (const std::exception& error) {
            instead(Reply::failure, error.what());
        }
        head = {static_cast<std::uint32_t>(kind), static_cast<std::uint32_t>(reply.bytes().size())};
        write_fully(to, &head, sizeof head);
        write_fully(to, reply.bytes().data(), reply.bytes().size());
    }
}

} // namespace raywise::contract
