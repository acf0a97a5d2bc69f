#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "emulator/behaviour/profile.h"
#include "emulator/behaviour/reader.h"

namespace fauxboard::behaviour {

/// What frames need to be compiled: the other names of the profile.
struct FrameContext {
    const Json& frames;  ///< the profile's section, for lines taken over from another frame
    const std::map<std::string, std::size_t, std::less<>>& index;
    const Names& names;          ///< for what is done
    const Names& request_names;  ///< for what is written: with a request's parameters
    const machine::MachineConfig& machine;
    protocol::FrameStyle style;  ///< of frames that do not say theirs
    protocol::LineEnd end;       ///< the same
};

/// Compiles the frames of a profile.
class FrameLoader {
  public:
    FrameLoader(Findings& findings, const FrameContext& context) : findings_(findings), context_(context) {}

    void load(const Json& node, const std::string& pointer, Frame& frame);
    /// How many cells the frames have between them.
    std::size_t cells() const { return cells_.size(); }

  private:
    void load_ways(ObjectReader& reader, Frame& frame);
    void load_cell(ObjectReader& reader, Frame& frame);
    void load_lines(const Json& node, const std::string& pointer, Frame& frame);
    void load_line(const Json& node, const std::string& pointer, Frame& frame);
    void take_over(ObjectReader& reader, const std::vector<Condition>& when, Frame& frame);
    void take_over(const Json& node, const std::string& pointer, Frame& frame);
    std::vector<Condition> conditions(ObjectReader& reader, bool loop);
    FrameTemplate compile(const Json& node, const std::string& pointer, bool loop);

    Findings& findings_;
    const FrameContext& context_;
    /// Around the lines that are being taken over from another frame.
    struct Around {
        std::string prefix;
        std::string suffix;
        std::vector<Condition> when;
        int depth = 0;
    };
    Around around_;
    std::map<std::string, std::size_t, std::less<>> cells_;
};

}  // namespace fauxboard::behaviour
