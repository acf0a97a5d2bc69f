// The JSON text of a scenario: refused with sentences that name the file, or played for a while.
//
// The input is the text. Names that it includes are found among the shipped scenarios. What is loaded is
// played on an A30T, with a virtual screen behind a line whose faults it may change, until it is done, a
// minute of virtual time has passed, or it was given a number of turns.

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "emulator/behaviour/document.h"
#include "emulator/fault/faults.h"
#include "emulator/screen/screen.h"
#include "emulator/script/loader.h"
#include "emulator/script/player.h"
#include "protocol/framing.h"
#include "tests/fuzz/screen_support.h"
#include "tests/fuzz/support.h"

namespace fauxboard::fuzz {
namespace {

using machine::SimTime;

constexpr SimTime longest_run{60'000'000};
constexpr int most_turns = 4000;

std::optional<behaviour::SourceText> find_scenario(std::string_view name, std::string_view) {
    if (name.find('/') != std::string_view::npos) {
        return std::nullopt;
    }
    const std::string file =
        std::string(FAUXBOARD_SOURCE_DIR "/profiles/scenarios/") + std::string(name) + ".json";
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        return std::nullopt;
    }
    return behaviour::SourceText{file, std::string(std::istreambuf_iterator<char>(in), {})};
}

/// Board and screen on one line, without a host.
class Bench final : public script::Stage, private fault::FaultControl {
  public:
    Bench(const script::Cast& cast, script::Player& player)
        : board_(cast.profile, {}, {false, 1, &player}), screen_(cast.screen) {
        board_.power_on(SimTime{0});
        screen_.power_on(SimTime{0});
    }

    /// Moves everything on to `now` and hands bytes over. When something is next due.
    SimTime step(SimTime now) {
        now_ = now;
        for (int i = 0; i < 64; ++i) {
            const SimTime board_due = board_.advance(now);
            faults_.to_screen().push(now, board_.output());
            board_.clear_output();
            const SimTime screen_due = screen_.advance(now);
            faults_.to_board().push(now, screen_.output());
            screen_.clear_output();
            const SimTime faults_due = faults_.advance(now);
            const bool quiet = faults_.to_screen().output().empty() && faults_.to_board().output().empty();
            screen_.receive(now, faults_.to_screen().output());
            board_.receive(now, faults_.to_board().output());
            faults_.to_screen().clear_output();
            faults_.to_board().clear_output();
            if (quiet) {
                return std::min({board_due, screen_due, faults_due});
            }
        }
        return now + SimTime{1000};
    }
    /// The board answers when the line and the machine are whole again.
    void finish() {
        faults_.clear(now_);
        board_.tinker(now_, [](machine::Machine& p) { p.faults.clear(); });
        board_.power_on(now_);
        board_.clear_output();
        board_.receive(now_, protocol::frame("M105"));
        for (int i = 0; i < 8; ++i) {
            if (board_.output().find("L2 ") != std::string_view::npos) {
                return;
            }
            board_.clear_output();
            board_.advance(now_ + SimTime{1'000'000});
        }
        require(false, "the board does not answer any more");
    }

    void visit(const std::function<void(board::Board&, SimTime)>& use) override { use(board_, now_); }
    fault::FaultControl* faults() override { return this; }
    const screen::Screen* screen() override { return &screen_; }
    screen::PressResult press(std::string_view path) override { return screen_.press(path, now_); }
    void note(std::string_view) override {}

  private:
    fault::FaultId add(const fault::FaultSpec& spec) override { return faults_.add(now_, spec); }
    bool change(fault::FaultId id, const fault::FaultSpec& spec) override {
        return faults_.change(now_, id, spec);
    }
    bool remove(fault::FaultId id) override { return faults_.remove(now_, id); }
    void clear() override { faults_.clear(now_); }
    std::vector<fault::FaultStatus> list() const override { return faults_.list(now_); }

    board::Board board_;
    screen::Screen screen_;
    fault::Faults faults_;
    SimTime now_{0};
};

void play(const std::shared_ptr<const script::Scenario>& scenario) {
    script::Player player(scenario, 1);
    Bench bench(scenario->cast, player);
    SimTime now{0};
    for (int turn = 0; turn < most_turns && now < longest_run && !player.done(); ++turn) {
        const SimTime due = bench.step(now);
        const SimTime next = player.advance(now, now, bench);
        require(player.done() || next > now, "what is due is left undone");
        require(!player.wants_turn() || player.done(), "what has passed is left unseen");
        now = std::max(now + SimTime{1}, std::min({due, next, longest_run}));
    }
    player.interrupt(now, "by the fuzzer");
    require(player.done() && player.outcome().sentence.starts_with(scenario->name), "no sentence at the end");
    require(!script::outcome_junit(*scenario, player.outcome()).empty(), "no report");
    require(script::outcome_json(*scenario, player.outcome(), script::Json::object()).is_object(),
            "no report");
    bench.finish();
}

}  // namespace
}  // namespace fauxboard::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace fauxboard;
    const behaviour::SourceText source{"input.json",
                                       std::string(data, data + std::min<std::size_t>(size, 8192))};
    script::Cast cast{fuzz::shipped_profile("geeetech-a30t"), fuzz::shipped_screen("geeetech-a30t")};
    try {
        script::read_head(source);
        fuzz::play(script::load_scenario(source, fuzz::find_scenario, cast));
    } catch (const behaviour::ProfileError& error) {
        fuzz::require(!error.problems().empty(), "refused without a reason");
        for (const behaviour::Problem& problem : error.problems()) {
            fuzz::require(!problem.file.empty() && !problem.message.empty(),
                          "a reason without file or words");
        }
    }
    return 0;
}
