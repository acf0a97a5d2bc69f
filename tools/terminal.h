#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "emulator/link/event_loop.h"
#include "emulator/link/unique_fd.h"
#include "emulator/screen/console.h"

namespace fauxboard::tools {

/// The terminal on stdin and stdout as cells, keys and clicks. One at a time. Whatever ends its life
/// restores the terminal.
class Terminal {
  public:
    struct Events {
        std::function<void(const screen::Key&)> on_key;
        std::function<void()> on_resize;
        std::function<void()> on_hangup;  ///< nobody is there any more
    };

    /// Whether stdin and stdout are a terminal.
    static bool here();

    /// Takes the terminal over. Throws link::HostError when it knows no way to draw on it.
    Terminal(link::EventLoop& loop, Events events);
    ~Terminal();
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    int columns() const;
    int rows() const;
    void draw(const screen::Layout& layout);

  private:
    struct Curses;  ///< its header's macros stay in terminal.cpp

    void on_resized();
    void read_keys();

    Events events_;
    link::Signals resized_;
    std::unique_ptr<Curses> curses_;
    link::UniqueFd terminal_;
    link::Watch keys_;
};

}  // namespace fauxboard::tools
