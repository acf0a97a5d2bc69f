#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/fault/dice.h"
#include "emulator/screen/screen.h"
#include "emulator/world/cast.h"
#include "emulator/world/disk.h"
#include "emulator/world/invariants.h"
#include "emulator/world/ledger.h"
#include "emulator/world/scene.h"
#include "emulator/world/stores.h"

namespace fauxboard::world {

/// A promise was broken: what() is "NAME: what was found (PROMISE)".
struct Broken : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One board with all that can happen to it: a screen, a host and a network that behave and misbehave, a
/// disk, an EEPROM, the power, faults of the printer, and time that crawls or jumps. No clock, no I/O.
///
/// What happens is drawn from the seed and the number of each step alone, so that leaving out other steps
/// changes nothing of it. Every call may throw Broken.
class World final : private board::Observer {
  public:
    /// `listener`, which may be null, is told what is heard and said as well.
    World(const Cast& cast, std::uint64_t seed, board::Observer* listener = nullptr);
    ~World() override;

    /// Lets some time pass, and does the thing of that number.
    void step(std::uint64_t number);
    /// Takes all troubles away, and asks each line once.
    void peace();

    SimTime time() const { return past_ + now_; }  ///< of all boards one after the other
    std::uint64_t digest() const { return digest_; }
    std::uint64_t requests() const { return requests_; }

    // For the things that happen (steps.cpp).
    // -------------------------------------------------------------------------------------------

    /// Bytes for the board; what comes of them is seen to.
    void say(board::Channel channel, std::string_view bytes);
    /// A command of the USB side, framed as hosts do. Whether it was taken; else the next one has its number.
    bool command(std::string_view body);
    void let_most_be_acknowledged();
    void datagram(std::uint64_t peer, std::string_view bytes);
    /// What is answered to it at once.
    std::string told(std::uint64_t peer, std::string_view bytes);
    void pass(SimTime time);
    void tinker(const std::function<void(machine::Machine&)>& use);
    /// What waits for the user has his word.
    void user_continues();
    /// One of the words of behaviour::action_words(); what the machine refuses is no harm.
    void act(std::string_view words);
    void reset();
    void reset_amid_line();
    void power_cut(fault::Dice& dice);
    void reload();
    void touch(fault::Dice& dice);
    /// Begins a print from the card.
    void print(const std::string& file);
    /// A file whose whole content is `content`, as soon as it stands under its name.
    void will_be(const std::string& path, std::string content) {
        ledger_.whole[path].insert(std::move(content));
    }
    /// The board has acknowledged that this file is there as a whole.
    void is_saved(const std::string& path, std::string_view content);
    void misset() { ledger_.misset = true; }
    void harmed() { ledger_.harmed = true; }
    /// For who listens: what was done to the machine.
    void remark(const std::string& text);
    void new_job() { ++ledger_.job_number; }
    /// How many commands of the USB side still wait for their acknowledgement.
    std::int64_t owed() const;

    const Cast& cast() const { return cast_; }
    board::Board& board() { return *board_; }
    Disk& disk() { return disk_; }
    Eeprom& eeprom() { return eeprom_; }
    SimTime now() const { return now_; }

  private:
    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_notice(SimTime now, board::Level level, std::string_view text) override;
    void on_power_on(SimTime now) override;
    void on_event(SimTime now, machine::EventId event) override;

    void make_board();
    void run_to(SimTime time);
    void take_output();
    void note(std::string_view bytes);
    void look(Moment moment, board::Channel channel = board::Channel::main, std::string_view output = {});
    void after_step();
    void ask(board::Channel channel);
    void let_moves_end();
    /// Until that is no longer so, or a month and more has passed.
    void rest_while(const std::function<bool()>& goes_on);
    void close_files();
    std::string framed(std::string_view request) const;
    void hurry();
    void walk(int moves, bool hasty);
    void proof_print();
    bool prints() const;
    void note_place();

    const Cast& cast_;
    std::uint64_t seed_;
    board::Observer* listener_;
    Disk disk_;
    Eeprom eeprom_;
    EepromCells eeprom_cells_;
    JobPlace job_place_;
    std::unique_ptr<board::Board> board_;
    std::optional<screen::Screen> screen_;
    std::optional<Scene> scene_;
    Ledger ledger_;
    SimTime now_{0};
    SimTime past_{0};
    std::optional<SimTime> told_to_jump_;          ///< a line said that the job goes on elsewhere
    std::optional<board::Verdict> first_verdict_;  ///< of the lines that a command of the host is
    std::int64_t line_number_ = 0;                 ///< of the USB side's commands
    std::string heard_;                            ///< on the line that is being asked
    board::Channel asked_ = board::Channel::main;
    std::uint64_t digest_ = 0xCBF29CE484222325U;
    std::uint64_t requests_ = 0;
};

}  // namespace fauxboard::world
