// No line at all: a board whose screen is not there.

#include "emulator/link/link.h"

namespace fauxboard::link {
namespace {

class NoLink final : public Link {
  public:
    void open(LinkListener& /*listener*/) override { state_ = LinkState::waiting; }
    void close() override { state_ = LinkState::opening; }
    void write(std::string_view message) override {
        stats_.bytes_lost += message.size();
        ++stats_.writes_lost;
    }
    LinkState state() const override { return state_; }
    const LinkStats& stats() const override { return stats_; }
    std::string describe() const override { return "no line"; }
    std::string kind() const override { return "none"; }
    std::string path() const override { return {}; }

  private:
    LinkState state_ = LinkState::opening;
    LinkStats stats_;
};

}  // namespace

std::unique_ptr<Link> make_no_link() {
    return std::make_unique<NoLink>();
}

}  // namespace fauxboard::link
