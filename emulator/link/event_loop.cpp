#include "emulator/link/event_loop.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

#include "emulator/link/error_text.h"
#include "emulator/link/link.h"

namespace fauxboard::link {

namespace {

constexpr std::uint32_t read_events = EPOLLIN | EPOLLRDHUP | EPOLLET;
constexpr int forever = -1;
constexpr int unarmed_ms = 10;  ///< between two looks at the moments while there is no alarm for them

[[noreturn]] void fail(const char* what) {
    throw LinkError(fmt::format("The event loop has no {}: {}.", what, error_text(errno)));
}

}  // namespace

// ---- the loop ----

EventLoop::EventLoop()
    : epoll_(::epoll_create1(EPOLL_CLOEXEC)),
      alarm_(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {
    if (!epoll_ || !alarm_) fail("descriptor");
    // Edge-triggered, so that it need not be read: it is set anew before it is waited for again.
    epoll_event event{EPOLLIN | EPOLLET, {nullptr}};
    if (::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, alarm_.get(), &event) != 0) fail("alarm");
}

EventLoop::~EventLoop() {
    tasks_.clear();  // first: with them may end what is still on the other lists
}

void EventLoop::run() {
    while (!stopped_ && has_work())
        turn(forever);
}

bool EventLoop::run_one() {
    if (!has_work()) return false;
    turn(forever);
    return true;
}

bool EventLoop::run_one_for(std::chrono::milliseconds limit) {
    if (!has_work()) return false;
    turn(static_cast<int>(std::clamp<std::int64_t>(limit.count(), 0, std::numeric_limits<int>::max())));
    return true;
}

bool EventLoop::poll() {
    return turn(0);
}

bool EventLoop::has_work() const {
    return watching_ != 0 || !tasks_.empty() ||
           std::any_of(timers_.begin(), timers_.end(),
                       [](const Timer* timer) { return timer->when_ != Timer::unset; });
}

bool EventLoop::turn(int wait_ms) {
    bool done = run_tasks();
    if (stopped_) return done;
    if (done || !tasks_.empty() || !due_.empty()) wait_ms = 0;
    bool alarm = !arm_alarm();  // without one the moments are looked at ever so often
    wait_ms = alarm && (wait_ms == forever || wait_ms > unarmed_ms) ? unarmed_ms : wait_ms;
    const int count = ::epoll_wait(epoll_.get(), events_.data(), static_cast<int>(events_.size()), wait_ms);
    if (count < 0 && errno != EINTR) {
        throw LinkError(fmt::format("The event loop cannot wait: {}.", error_text(errno)));
    }
    alarm |= count < 0;
    for (int i = 0; i < count; ++i) {  // nobody is called meanwhile, so all of them are still there
        const epoll_event& event = events_[static_cast<std::size_t>(i)];
        auto* const watch = static_cast<Watch*>(event.data.ptr);
        if (watch == nullptr) {
            alarm = true;
        } else {
            watch->ready_ |= event.events;
            if (watch->wants_call()) queue(*watch);
        }
    }
    // What has come is heard before it is judged whether anything came in time.
    done |= call_watches();
    if (alarm) {
        armed_ = Timer::unset;
        done |= ring_timers();
    }
    return done;
}

bool EventLoop::run_tasks() {
    if (tasks_.empty()) return false;
    std::swap(running_, tasks_);  // what they post is for the next turn
    for (const Task& task : running_) {
        if (stopped_) break;  // for good: what is left is dropped
        task();
    }
    running_.clear();
    return true;
}

// ---- moments ----

// An alarm that comes too early costs one turn; moving it costs a system call each time, and most moments
// that are asked for are put off before they come.
bool EventLoop::arm_alarm() {
    auto first = Timer::unset;
    for (const Timer* timer : timers_)
        first = std::min(first, timer->when_);
    if (first >= armed_) return true;
    // 0 would disarm it.
    const auto ns = std::max<std::int64_t>(
        1, std::chrono::duration_cast<std::chrono::nanoseconds>(first.time_since_epoch()).count());
    itimerspec moment{};
    moment.it_value.tv_sec = static_cast<time_t>(ns / 1'000'000'000);
    moment.it_value.tv_nsec = static_cast<long>(ns % 1'000'000'000);
    const bool armed = ::timerfd_settime(alarm_.get(), TFD_TIMER_ABSTIME, &moment, nullptr) == 0;
    armed_ = armed ? first : Timer::unset;
    return armed;
}

// Each timer once: one that is set to a moment that is past waits for the next turn.
bool EventLoop::ring_timers() {
    const auto now = Timer::Clock::now();
    ++round_;
    bool any = false;
    while (!stopped_) {
        Timer* next = nullptr;
        for (Timer* timer : timers_) {
            if (timer->when_ <= now && timer->round_ != round_ &&
                (next == nullptr || timer->when_ < next->when_)) {
                next = timer;
            }
        }
        if (next == nullptr) break;
        next->when_ = Timer::unset;
        next->round_ = round_;
        const auto on_ring = next->on_ring_;  // kept, should the timer end by its own call
        (*on_ring)();
        any = true;
    }
    return any;
}

Timer::Timer(EventLoop& loop, std::function<void()> on_ring)
    : loop_(loop), on_ring_(std::make_shared<const std::function<void()>>(std::move(on_ring))) {
    loop_.timers_.push_back(this);
}

Timer::~Timer() {
    std::erase(loop_.timers_, this);
}

// ---- descriptors ----

void EventLoop::queue(Watch& watch) {
    if (std::exchange(watch.queued_, true)) return;
    due_.push_back(&watch);
}

void EventLoop::forget(Watch& watch) {
    std::replace(calling_.begin(), calling_.end(), &watch, static_cast<Watch*>(nullptr));
    if (std::exchange(watch.queued_, false)) std::erase(due_, &watch);
}

bool EventLoop::call_watches() {
    if (due_.empty()) return false;
    std::swap(calling_, due_);
    for (Watch* const& watch : calling_) {  // null as soon as a call stops it
        if (watch != nullptr) watch->queued_ = false;
        if (watch != nullptr && !stopped_ && watch->may_write()) watch->call_writable(watch);
        if (watch != nullptr && !stopped_ && watch->may_read()) watch->call_readable();
        if (watch != nullptr && watch->wants_call()) queue(*watch);
    }
    calling_.clear();
    return true;
}

Watch::Watch(EventLoop& loop, std::function<void()> on_readable, std::function<void()> on_writable)
    : loop_(loop),
      on_readable_(std::make_shared<const std::function<void()>>(std::move(on_readable))),
      on_writable_(std::make_shared<const std::function<void()>>(std::move(on_writable))) {}

void Watch::start(int fd) {
    stop();
    fd_ = fd;
    held_ = false;
    if (!arm(EPOLL_CTL_ADD, read_events)) {
        fd_ = -1;
        throw LinkError(fmt::format("The event loop cannot watch descriptor {}: {}.", fd, error_text(errno)));
    }
    ++loop_.watching_;
}

void Watch::stop() {
    if (!active()) return;
    loop_.forget(*this);
    (void)::epoll_ctl(loop_.epoll_.get(), EPOLL_CTL_DEL, fd_, nullptr);
    --loop_.watching_;
    fd_ = -1;
    ready_ = 0;
    held_ = false;
    write_awaited_ = false;
}

void Watch::hold(bool held) {
    held_ = held;
    if (wants_call()) loop_.queue(*this);
}

void Watch::call_readable() {
    const auto call = on_readable_;
    (*call)();
}

void Watch::call_writable(Watch* const& self) {
    write_awaited_ = false;
    ready_ &= ~std::uint32_t{EPOLLOUT};
    const auto call = on_writable_;
    (*call)();
    if (self == nullptr || write_awaited_) return;
    arm(EPOLL_CTL_MOD, read_events);  // else every read of the other end would wake us
}

// Arming anew looks at the descriptor anew: what became writable before this is seen.
void Watch::await_writable() {
    if (!active() || std::exchange(write_awaited_, true)) return;
    ready_ &= ~std::uint32_t{EPOLLOUT};
    arm(EPOLL_CTL_MOD, read_events | EPOLLOUT);
}

bool Watch::arm(int operation, std::uint32_t events) {
    epoll_event event{events, {this}};
    return ::epoll_ctl(loop_.epoll_.get(), operation, fd_, &event) == 0;
}

// ---- signals ----

namespace {

/// Where the handler says that a signal came: the writing end of a pipe, by the signal's number.
std::array<std::atomic<int>, NSIG> signal_pipes;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not wait");

extern "C" void tell_signal(int number) {
    const int error = errno;
    const auto byte = static_cast<unsigned char>(number);
    // A pipe that is full has enough to tell.
    (void)!::write(signal_pipes[static_cast<std::size_t>(number)], &byte, 1);
    errno = error;
}

}  // namespace

std::vector<int> ending_signals() {
    std::vector<int> numbers{SIGINT,    SIGTERM, SIGHUP,    SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM,
                             SIGSTKFLT, SIGXCPU, SIGVTALRM, SIGPROF, SIGIO,   SIGPWR};
    // These do the same by default; a container's init is ended by one of them.
    for (int number = SIGRTMIN; number <= SIGRTMAX; ++number)
        numbers.push_back(number);
    return numbers;
}

std::string signal_name(int number) {
    const char* const name = ::sigabbrev_np(number);
    return name == nullptr ? fmt::format("signal {}", number) : fmt::format("SIG{}", name);
}

Signals::Signals(EventLoop& loop, const std::vector<int>& numbers, std::function<void(int)> on_signal)
    : on_signal_(std::move(on_signal)), watch_(loop, [this] { take(); }) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_NONBLOCK | O_CLOEXEC) != 0) fail("pipe for signals");
    out_.reset(ends[0]);
    in_.reset(ends[1]);
    watch_.start(out_.get());
    for (const int number : numbers) {
        signal_pipes.at(static_cast<std::size_t>(number)) = in_.get();
        struct sigaction action {};
        action.sa_handler = &tell_signal;  // no SA_RESTART: what blocks is interrupted
        Before before{number, {}};
        if (::sigaction(number, &action, &before.action) != 0) fail("sigaction");
        before_.push_back(before);
    }
}

Signals::~Signals() {
    for (const Before& before : before_)
        ::sigaction(before.number, &before.action, nullptr);
}

void Signals::take() {
    unsigned char number = 0;
    if (::read(out_.get(), &number, 1) == 1) {
        on_signal_(number);
    } else {
        watch_.drained();
    }
}

}  // namespace fauxboard::link
