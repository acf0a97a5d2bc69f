#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "emulator/machine/job_control.h"
#include "emulator/resin/names.h"
#include "emulator/resin/resin_axis.h"
#include "emulator/resin/resin_settings.h"
#include "emulator/sliced/sliced_file.h"

namespace fauxboard::resin {

/// A print of a resin machine: homes, then layer by layer by the records of the file: down, dark until the
/// resin rests, exposure, lift. The job's place is the end of the picture exposed last, never anything
/// between.
///
/// Each phase ends at a time that is known when it begins, or with a move of the axis.
class ResinJob {
  public:
    enum class Phase : std::uint8_t {
        idle,
        homing,
        reading,      ///< the record of the next layer
        approaching,  ///< down to the layer's height
        resting,      ///< at its height, still dark
        exposing,
        lifting,
        waiting,    ///< after the lift
        finishing,  ///< what M8489 says is done after a print
        held        ///< paused
    };

    ResinJob(const ResinConfig& config, ResinAxis& axis, const ResinSettings& settings, Job& job,
             const Storage& storage, EventQueue& events, machine::JobControl& control)
        : config_(config),
          axis_(axis),
          settings_(settings),
          job_(job),
          storage_(storage),
          events_(events),
          control_(control) {}

    void power_on();
    /// Reads the head of the selected file. False when it is no file that can be printed.
    bool open();
    /// To be called with a file open().
    void start(SimTime now);
    /// A pause was asked for; it shows at `due`.
    void pause(SimTime due) { pause_due_ = due; }
    void resume(SimTime now);
    /// The job is over, before its end or at it: the platform goes where it is to go after a print.
    void stop(SimTime now);
    /// All at once: dark, and nothing moves.
    void halt(SimTime now);

    void advance(SimTime now);
    SimTime next_event() const;

    Phase phase() const { return phase_; }
    /// Every layer is exposed: what is left is the last lift and what is done after a print.
    bool exposed_all() const;
    /// Leaves that out: the job is finished where the platform stands.
    void cut_end(SimTime now);
    bool exposing() const { return phase_ == Phase::exposing; }
    /// Light of the layer under way, 0 to 255; 0 in the dark.
    int light() const;
    /// Of the exposure under way or interrupted, s.
    double exposure_left_s(SimTime now) const;
    /// The file that is being printed, and the layer under way, from 0; nothing while no job is.
    struct Place {
        const sliced::SlicedFile& file;
        const machine::Volume& disk;
        const std::string& path;
        std::uint32_t layer;
    };
    std::optional<Place> place() const;
    /// Height of the layer under way, mm.
    double layer_z_mm() const { return layer_.z_mm; }

  private:
    bool step(SimTime now);
    void after_move(SimTime now);
    void after_time(SimTime now);
    void begin_layer(SimTime now);
    void approach(SimTime now);
    void end_exposure(SimTime now);
    void lift(SimTime now);
    void finish(SimTime now);
    void finished(SimTime now);
    void hold(SimTime now);
    void lose_file(EventId why, SimTime now);
    bool moves() const;

    const ResinConfig& config_;
    ResinAxis& axis_;
    const ResinSettings& settings_;
    Job& job_;
    const Storage& storage_;
    EventQueue& events_;
    machine::JobControl& control_;
    std::optional<sliced::SlicedFile> file_;
    sliced::Layer layer_{};
    std::uint32_t index_ = 0;  ///< of layer_
    Phase phase_ = Phase::idle;
    Phase held_ = Phase::idle;  ///< where a paused job goes on
    bool stopped_ = false;      ///< finishing, and the job is over already
    SimTime until_{0};          ///< end of a phase that is a time
    SimTime dark_since_{0};
    SimTime exposure_left_{0};  ///< of an exposure that a pause broke off, or that is still to begin
    SimTime pause_due_ = never;
};

/// "exposing": for fields and people.
std::string_view to_string(ResinJob::Phase phase);

}  // namespace fauxboard::resin
