#include "tests/support/marlin.h"

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/fields.h"
#include "tests/support/board_driver.h"

namespace fauxboard::testing {
namespace {

nlohmann::json vector_file() {
    std::ifstream file(std::string(FAUXBOARD_SOURCE_DIR) + "/tests/vectors/marlin.json");
    return nlohmann::json::parse(file);
}

}  // namespace

std::vector<MarlinVector> marlin_vectors() {
    std::vector<MarlinVector> vectors;
    const nlohmann::json file = vector_file();  // outlives the loop over a part of it
    for (const auto& node : file.at("vectors")) {
        vectors.push_back(
            {node.at("name"), node.value("world", std::string{}), node.at("send"), node.at("reply")});
    }
    return vectors;
}

std::string marlin_profile() {
    return vector_file().at("profile");
}

MarlinBench::MarlinBench(const std::string& profile) : MarlinBench(shipped_profile(profile)) {}

MarlinBench::MarlinBench(std::shared_ptr<const behaviour::Profile> profile)
    : board_(std::move(profile), {&card, nullptr, nullptr, nullptr}, board::Options{}) {
    put("TEST.GCO", std::string(1233, ';') + "\n");
    board_.connect(board::Channel::host, true);
    board_.power_on(machine::SimTime{0});
    take();
    run_for(1);
    forget();
}

void MarlinBench::put(const std::string& name, const std::string& text) {
    REQUIRE(card.create(name));
    REQUIRE(card.append(name, 0, text));
}

void MarlinBench::world(std::string_view phrase) {
    REQUIRE(board_.world(machine::from_seconds(now_), phrase));
    run_for(0.01);
}

void MarlinBench::take() {
    for (const board::Channel channel : {board::Channel::main, board::Channel::host}) {
        said_[static_cast<std::size_t>(channel)] += board_.output(channel);
    }
    board_.clear_output();
}

void MarlinBench::feed(std::string_view bytes, board::Channel channel) {
    board_.receive(machine::from_seconds(now_), bytes, channel);
    take();
}

void MarlinBench::say(std::string_view line, board::Channel channel, double seconds) {
    feed(std::string(line) + "\n", channel);
    run_for(seconds);
}

void MarlinBench::run_for(double seconds) {
    now_ += seconds;
    const machine::SimTime end = machine::from_seconds(now_);
    while (board_.advance(end) <= end) {
        take();
    }
    take();
}

void MarlinBench::home() {
    say("G28");
    run_for(30);
    forget();
}

std::string MarlinBench::told(std::string_view line, double seconds, board::Channel channel) {
    forget();
    say(line, channel, seconds);
    return said(channel);
}

double MarlinBench::number(std::string_view path) const {
    const behaviour::Field* field = behaviour::find_field(path);
    REQUIRE(field != nullptr);
    return field->get(board_.machine()).number;
}

}  // namespace fauxboard::testing
