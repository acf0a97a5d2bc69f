#include "tests/support/vectors.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "emulator/behaviour/wire_text.h"

namespace fauxboard::testing {
namespace {

using nlohmann::json;

std::string wire(const json& text) {
    const auto bytes = behaviour::to_wire(text.get<std::string>());
    if (!bytes) {
        throw std::runtime_error("not Latin-1: " + text.dump());
    }
    return *bytes;
}

std::vector<std::string> texts(const json& vector, const char* key) {
    std::vector<std::string> out;
    for (const json& item : vector.value(key, json::array())) {
        out.push_back(wire(item));
    }
    return out;
}

Vector read_vector(const json& node) {
    Vector out;
    out.button = node.at("button").get<std::string>();
    for (const json& item : node.value("prepare", json::array())) {
        out.prepare.push_back({wire(item.at("send")), item.at("wait_s").get<double>()});
    }
    out.world = node.value("world", "");
    out.send = texts(node, "send");
    out.frame = texts(node, "frame");
    out.host = texts(node, "host");
    if (const json& replies = node.at("replies"); !replies.is_null()) {
        for (const json& item : replies) {
            const bool direct = item.is_object() && item.contains("direct");
            if (direct) {
                out.direct.insert(out.replies.size());
            }
            out.replies.push_back(direct             ? wire(item.at("direct"))
                                  : item.is_object() ? "raw:" + wire(item.at("raw"))
                                                     : wire(item));
        }
    }
    const json state = node.value("state", json::object());
    for (const auto& [path, value] : state.items()) {
        if (value.is_string()) {
            out.texts[path] = wire(value);
        } else {
            out.state[path] = value.get<double>();
        }
    }
    out.paced = node.value("paced", false);
    out.after_s = node.value("after_s", 2.0);
    out.takes_s = node.value("takes_s", 0.0);
    return out;
}

}  // namespace

VectorFile load_vectors(std::string_view name) {
    const std::string path = FAUXBOARD_SOURCE_DIR "/tests/vectors/" + std::string(name) + ".json";
    std::ifstream in(path);
    const json root = json::parse(in);
    VectorFile file;
    file.profile = root.at("profile").get<std::string>();
    file.bare = root.value("bare", false);
    for (const json& node : root.at("vectors")) {
        file.vectors.push_back(read_vector(node));
    }
    return file;
}

}  // namespace fauxboard::testing
