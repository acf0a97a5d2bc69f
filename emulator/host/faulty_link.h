#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/fault/fault_control.h"
#include "emulator/fault/faults.h"
#include "emulator/host/clock.h"
#include "emulator/link/link.h"

namespace fauxboard::host {

/// A link whose line misbehaves on purpose: both directions run through fault::Faults in virtual time, and a
/// disconnection takes the inner link away and brings it back. Without a fault bytes go straight through.
///
/// Like every link it calls its listener from the event loop only. Faults may be changed at any time, also
/// from inside the listener and before open(); what that sets free comes at once, to the listener on the
/// loop's next turn.
class FaultyLink final : public link::Link, public fault::FaultControl, private link::LinkListener {
  public:
    /// `inner` is closed, and used by nobody else; it and `clock` outlive this. `reads` says which way the
    /// bytes go that are read from it: Direction::to_board where the screen is at the other end, and
    /// to_screen where the board is.
    FaultyLink(link::Link& inner, Clock& clock, fault::Direction reads);
    ~FaultyLink() override;

    fault::FaultId add(const fault::FaultSpec& spec) override;
    bool change(fault::FaultId id, const fault::FaultSpec& spec) override;
    bool remove(fault::FaultId id) override;
    /// A link that was taken away comes back.
    void clear() override;
    std::vector<fault::FaultStatus> list() const override { return faults_.list(clock_.now()); }

    /// See fault::FaultLine::on_deed().
    void on_deed(const std::function<void(const fault::Deed&)>& told) { faults_.on_deed(told); }

    void open(link::LinkListener& listener) override;
    void close() override;
    void write(std::string_view message) override;
    std::size_t pending() const override { return inner_.pending(); }
    void hold(bool held) override;
    /// `waiting` while a disconnection lasts.
    link::LinkState state() const override;
    /// Of the inner link, so after what faults did to the bytes written, and before what they do to those
    /// read; and as lost, what was written during a disconnection.
    const link::LinkStats& stats() const override;
    /// As it was when the line was last there.
    std::string describe() const override { return connected_ ? inner_.describe() : describe_; }
    std::string path() const override { return connected_ ? inner_.path() : path_; }
    std::string kind() const override { return inner_.kind(); }

  private:
    void on_bytes(std::string_view bytes) override;
    void on_state(link::LinkState state, std::string_view why) override;
    void on_drained() override;

    fault::FaultLine& incoming() { return reads_to_board_ ? faults_.to_board() : faults_.to_screen(); }
    fault::FaultLine& outgoing() { return reads_to_board_ ? faults_.to_screen() : faults_.to_board(); }
    void settle();
    void send();
    void take_away();
    void bring_back();
    void ring();
    void deliver();
    void open_inner();

    link::Link& inner_;
    Clock& clock_;
    bool reads_to_board_;
    fault::Faults faults_;
    std::unique_ptr<Alarm> alarm_;
    link::LinkListener* listener_ = nullptr;
    bool connected_ = false;         ///< the inner link is open
    bool held_ = false;              ///< the listener wants no bytes
    bool complained_ = false;        ///< that the link does not come back
    SimTime retry_{0};               ///< when it may be opened again
    std::vector<std::string> news_;  ///< sentences for the listener's on_state
    std::string describe_;
    std::string path_;
    std::uint64_t writes_refused_ = 0;
    std::uint64_t bytes_refused_ = 0;
    mutable link::LinkStats stats_;
    std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< a listener may destroy this
};

/// For a person: "Fault 1, drop:to_screen,every=2, acted 5 times on 10 lines."; for both directions "Fault 2,
/// drop:every=2, acted 5 times on 10 lines to the screen, once on 2 lines to the board."
std::string fault_sentence(const fault::FaultStatus& status);

}  // namespace fauxboard::host
