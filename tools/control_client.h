#pragma once

// The client's end of a control channel, for `fauxboard ctl`.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "emulator/link/unique_fd.h"

namespace fauxboard::tools {

using Json = nlohmann::ordered_json;

/// A connection to a running board. Waits; the program has nothing else to do.
class ControlClient {
  public:
    enum class Got { line, end, silence };

    /// Waits a moment for a board that is just starting; throws link::LinkError when nobody listens there
    /// even then. `timeout_ms`: how long receive() waits; -1 for ever.
    ControlClient(const std::string& path, int timeout_ms);

    /// False when the other end is gone.
    bool send(std::string_view bytes) const;
    bool ask(const Json& request) const { return send(request.dump() + "\n"); }
    /// No more requests will come; answers still do.
    void finish() const;
    /// The next line, without its end.
    Got receive(std::string& line);
    /// Copies bytes between `in`, the channel and `out` until the channel ends: requests and answers as they
    /// are.
    void copy(int in, int out);

  private:
    link::UniqueFd fd_;
    std::string rest_;
    int timeout_ms_;
};

}  // namespace fauxboard::tools
