#pragma once

// Short lives of the real program, each with other things that it works with: files, lines, sockets, a
// panel. In each of them one call of the system can be made to fail.

#include <sys/types.h>

#include <string>
#include <vector>

#include "tests/link/helpers.h"

namespace fauxboard::calls {

enum class Life : std::uint8_t {
    played,    ///< a scenario at once, with every file that a board keeps
    met,       ///< a moment of real time, in which somebody comes by TCP and UDP
    uploaded,  ///< a file comes by UDP, and somebody looks at the page in the browser
    shown,     ///< a board with a UV panel: pictures, the wires to it, its EEPROM
    fleet,     ///< three boards in one process
};
constexpr std::size_t life_count = 5;
const char* to_string(Life life);

/// Exit codes that no program has.
constexpr int killed = 1000;  ///< and the signal
constexpr int hung = 2000;

/// One call of the system that is to fail.
struct FailingCall {
    const char* name;
    int error;
    long nth;   ///< from 1
    bool ever;  ///< and all after it
};

struct LifeEnd {
    int code = 0;
    bool happened = false;      ///< there was such a call at all
    std::string said;           ///< the beginning of its stderr
    bool acknowledged = false;  ///< the upload, as saved
    std::string missing;        ///< a file that such a life makes, and did not
    std::string torn;           ///< a file that is neither as it was nor as it is to be, and why
};

class ShortLife {
  public:
    explicit ShortLife(Life life);
    LifeEnd run(const FailingCall& failing);
    /// In which all calls do what they are to do.
    LifeEnd run() { return run({"none", 0, 0, false}); }

  private:
    std::vector<std::string> arguments() const;
    [[noreturn]] void become(const FailingCall& failing, int out, int errors) const;
    /// Whoever comes by while it runs.
    void visit(pid_t pid, int out);
    void upload(const std::string& udp);
    std::string missing_file() const;
    std::string torn_file() const;
    std::string content(const std::string& name) const;

    Life life_;
    link::test::TemporaryFolder folder_;
    bool acknowledged_ = false;  ///< the upload, as saved
    std::vector<link::UniqueFd> peers_;
};

}  // namespace fauxboard::calls
