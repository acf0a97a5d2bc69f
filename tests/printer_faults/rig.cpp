#include "tests/printer_faults/rig.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "emulator/behaviour/fields.h"
#include "emulator/fault/printer_fault.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "tests/support/board_driver.h"

namespace fauxboard::testing {
namespace {

std::shared_ptr<const screen::ScreenProfile> screen_of(const std::string& name) {
    static std::map<std::string, std::shared_ptr<const screen::ScreenProfile>> known;
    auto& slot = known[name];
    if (slot == nullptr) {
        slot = host::load_screen_by_name(name);
    }
    return slot;
}

}  // namespace

LongCard::LongCard() : text_(";LAYER_COUNT:1\nG28\nM140 S50\nM109 S200\nM83\n;LAYER:0\n") {
    for (int i = 0; i < 4000; ++i) {
        text_ += "G1 X150 Y150 E1 F3000\nG1 X180 Y150 E1\nG1 X180 Y180 E1\nG1 X150 Y180 E1\n";
    }
}

bool LongCard::list(std::string_view folder, std::vector<machine::CardEntry>& out) const {
    if (!folder.empty()) {
        return false;
    }
    out.push_back({"long.gcode", false, text_.size()});
    return true;
}

machine::Volume::Kind LongCard::look(std::string_view path, std::uint64_t& bytes) const {
    bytes = text_.size();
    return path == "long.gcode" ? Kind::file : path.empty() ? Kind::folder : Kind::missing;
}

std::optional<std::size_t> LongCard::read(std::string_view path, std::uint64_t offset,
                                          std::span<char> out) const {
    if (path != "long.gcode") {
        return std::nullopt;
    }
    return offset >= text_.size() ? 0 : text_.copy(out.data(), out.size(), static_cast<std::size_t>(offset));
}

Rig::Rig(const std::string& board, const std::string& screen, const std::vector<std::string>& specs)
    : hub_(*this),
      board_(shipped_profile(board), {&card_, nullptr, nullptr}, {true, 1, this}),
      screen_(screen_of(screen)),
      session_(hub_, [] {}) {
    for (const std::string& spec : specs) {
        const fault::FaultSpec parsed = fault::fault_from_text(spec);
        REQUIRE(fault::is_for_printer(parsed));
        REQUIRE(machine().faults.add(now_, fault::to_request(parsed)) != 0);
    }
    board_.power_on(now_);
    screen_.power_on(now_);
}

void Rig::visit(const std::function<void(board::Board&, SimTime)>& use) {
    use(board_, now_);
}

void Rig::exchange() {
    for (bool moved = true; moved;) {
        moved = false;
        board_due_ = board_.advance(now_);
        if (const std::string bytes(board_.output()); !bytes.empty()) {
            board_.clear_output();
            screen_.receive(now_, bytes);
            moved = true;
        }
        screen_due_ = screen_.advance(now_);
        if (const std::string bytes(screen_.output()); !bytes.empty()) {
            screen_.clear_output();
            board_.receive(now_, bytes);
            moved = true;
        }
    }
}

void Rig::run_until(double seconds) {
    const SimTime end = machine::from_seconds(seconds);
    exchange();
    for (SimTime next = std::min(board_due_, screen_due_); next <= end;
         next = std::min(board_due_, screen_due_)) {
        now_ = std::max(next, now_ + SimTime{1});
        exchange();
    }
    now_ = std::max(now_, end);
    exchange();
}

void Rig::press(std::string_view body) {
    board_.receive(now_, protocol::frame(body));
    run_for(0.2);
}

void Rig::host(std::string_view line) {
    board_.receive(now_, std::string(line) + "\n", board::Channel::host);
}

control::Json Rig::ask(const control::Json& request) {
    session_.receive(request.dump() + "\n");
    const std::string out = session_.take_output();
    REQUIRE(!out.empty());
    control::Json answer = control::Json::parse(out.substr(0, out.find('\n')));
    exchange();
    return answer;
}

control::Json Rig::do_it(const control::Json& request) {
    control::Json answer = ask(request);
    CHECK_MESSAGE(answer["ok"].get<bool>(), answer.dump());
    return answer;
}

std::vector<std::string> Rig::said_since(double from) const {
    std::vector<std::string> out;
    for (const Line& line : lines_) {
        if (line.at >= from) {
            out.push_back(line.body);
        }
    }
    return out;
}

double Rig::number(std::string_view path) {
    board_.refresh(now_);
    const behaviour::Field* field = behaviour::find_field(path);
    REQUIRE_MESSAGE(field != nullptr, std::string(path));
    return field->get(board_.machine()).number;
}

std::string Rig::text(std::string_view path) {
    board_.refresh(now_);
    const behaviour::Field* field = behaviour::find_field(path);
    REQUIRE_MESSAGE(field != nullptr, std::string(path));
    return std::string(field->get(board_.machine()).text);
}

std::optional<int> Rig::exception_page() const {
    if (screen_.page().path != "Exception") {
        return std::nullopt;
    }
    return static_cast<int>(screen_.number("exception.code").value_or(-1));
}

std::string Rig::crashes() const {
    std::string out;
    for (const screen::Finding& finding : screen_.findings()) {
        if (finding.first.verdict == screen::Verdict::would_crash) {
            out += finding.first.sentence() + "\n";
        }
    }
    return out;
}

bool Rig::answers() {
    const double from = now();
    press("M105");
    const auto said = said_since(from);
    return std::any_of(said.begin(), said.end(),
                       [](const std::string& body) { return body.starts_with("L2 B:"); });
}

void Rig::on_received(SimTime now, board::Channel channel, std::string_view line, board::Verdict verdict) {
    hub_.on_received(now, channel, line, verdict);
}

void Rig::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    lines_.push_back({machine::to_seconds(now), said(line, board_.profile())});
    hub_.on_sent(now, channel, line);
}

void Rig::on_notice(SimTime now, board::Level level, std::string_view text) {
    hub_.on_notice(now, level, text);
}

}  // namespace fauxboard::testing
