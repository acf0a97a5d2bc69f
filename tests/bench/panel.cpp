// The page in the browser, and many boards in one process: what they cost, looked at and not.

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "protocol/framing.h"
#include "tests/bench/child.h"
#include "tests/bench/figure.h"

namespace fauxboard::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view reply_start = "N-0 L24 P5";

/// "http://127.0.0.1:4321/TOKEN/".
struct Address {
    explicit Address(const std::string& web)
        : port(static_cast<std::uint16_t>(std::stoi(web.substr(web.rfind(':') + 1)))),
          path(web.substr(web.find('/', web.rfind(':')))) {}
    std::uint16_t port;
    std::string path;
};

/// A client of the page that is no browser: it reads what comes and throws it away.
class Looker {
  public:
    explicit Looker(const Address& address)
        : address_(address), fd_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(address.port);
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (connect(fd_, reinterpret_cast<sockaddr*>(&to), sizeof to) != 0) {
            throw std::runtime_error("the panel takes no connection");
        }
    }
    ~Looker() { close(fd_); }
    Looker(const Looker&) = delete;
    Looker& operator=(const Looker&) = delete;

    void get(const std::string& what) {
        send_all("GET " + address_.path + what + " HTTP/1.1\r\n" + host() + "\r\n");
    }
    void post(const std::string& what, const std::string& body) {
        send_all("POST " + address_.path + what + " HTTP/1.1\r\n" + host() +
                 "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    }
    /// All that comes within a time, or until `part` has come.
    std::string read(int ms, std::string_view part = {}) {
        std::string text;
        const auto end = Clock::now() + std::chrono::milliseconds(ms);
        while (true) {
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
            pollfd wait{fd_, POLLIN, 0};
            std::array<char, 65536> bytes;
            if (left <= 0 || poll(&wait, 1, static_cast<int>(left)) <= 0) {
                return text;
            }
            const ssize_t n = ::read(fd_, bytes.data(), bytes.size());
            if (n <= 0) {
                return text;
            }
            text.append(bytes.data(), static_cast<std::size_t>(n));
            if (!part.empty() && text.find(part) != std::string::npos) {
                return text;
            }
        }
    }

  private:
    std::string host() const { return "Host: 127.0.0.1:" + std::to_string(address_.port) + "\r\n"; }
    void send_all(const std::string& text) const {
        if (send(fd_, text.data(), text.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(text.size())) {
            throw std::runtime_error("the panel takes no request");
        }
    }

    const Address& address_;
    int fd_;
};

/// A page that is open on one board: what the overview subscribes to.
struct OpenPage {
    explicit OpenPage(const Address& address, int board) : stream(address), asker(address) {
        const std::string live = "live/" + std::to_string(board);
        stream.get(live);
        const std::string hello = stream.read(5000, "\n\n");
        const std::size_t at = hello.find("\"session\": ");
        if (at == std::string::npos) {
            throw std::runtime_error("the panel opens no session");
        }
        const std::string session = std::to_string(std::stoul(hello.substr(at + 11)));
        std::string body;
        for (const char* topic :
             {"state", "traffic", "notices", "link", "screen", "judged", "spoiled", "drawing"}) {
            body += std::string(R"({"op": "subscribe", "topic": ")") + topic + "\"}\n";
        }
        asker.post(live + "/" + session, body);
        asker.read(5000, "\r\n\r\n");
    }
    Looker stream;
    Looker asker;
};

/// Latencies and processor time of requests to a board.
struct Asked {
    Asked(Child& of, Peer& through) : child(of), peer(through) {}
    void ask(const std::string& request, int times) {
        const double before = child.cpu_seconds();
        for (int i = 0; i < times; ++i) {
            const auto start = Clock::now();
            peer.write(request);
            peer.line(reply_start);
            latencies.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
        }
        cpu += child.cpu_seconds() - before;
    }
    double cpu_per_reply() const { return cpu * 1e6 / static_cast<double>(latencies.size()); }
    Child& child;
    Peer& peer;
    std::vector<double> latencies{};
    double cpu = 0;
};

/// Nobody looks: what a run with the panel costs more than one without.
std::vector<Figure> unseen(const Settings& settings) {
    const std::string request = protocol::frame("M290 Z0.01");
    BoardChild with(settings.program, {"--no-pacing", "--web"});
    BoardChild without(settings.program, {"--no-pacing"});
    Peer with_peer(with.path());
    Peer without_peer(without.path());
    Asked measured(with, with_peer);
    Asked least(without, without_peer);
    const int times = settings.smoke ? 20 : 500;
    measured.ask(request, times);  // both warm
    least.ask(request, times);
    for (Asked* side : {&measured, &least}) {
        side->latencies.clear();
        side->cpu = 0;
    }
    for (int round = 0; round < (settings.smoke ? 2 : 60);
         ++round) {  // in turns: what disturbs disturbs both
        measured.ask(request, times);
        least.ask(request, times);
    }
    return {{"processor time per reply with --web, nobody looks", "us", measured.cpu_per_reply(),
             least.cpu_per_reply(), 1.15}};
}

/// A client asks the page as fast as it can; the line's timing must not show it.
std::vector<Figure> flooded(const Settings& settings) {
    const std::string request = protocol::frame("M290 Z0.01");
    BoardChild board(settings.program, {"--no-pacing", "--web"});
    const Address address(board.web());
    Peer peer(board.path());
    Asked quiet(board, peer);
    Asked noisy(board, peer);
    const int times = settings.smoke ? 20 : 4000;
    quiet.ask(request, times);
    quiet.latencies.clear();
    quiet.ask(request, times);
    std::atomic<bool> stop = false;
    std::thread flood([&] {
        Looker client(address);
        while (!stop) {
            client.get("boards");
            client.read(1000, "]");
        }
    });
    try {
        noisy.ask(request, times);
    } catch (...) {
        stop = true;
        flood.join();
        throw;
    }
    stop = true;
    flood.join();
    return {{"request to reply while the page is flooded, p50", "us", median(noisy.latencies),
             median(quiet.latencies), 1.5}};
}

/// A file of a fleet in a folder of its own.
class FleetFile {
  public:
    explicit FleetFile(int boards) {
        std::string name = (std::filesystem::temp_directory_path() / "fauxboard-bench-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error("no temporary folder");
        }
        folder_ = name;
        std::ofstream(path()) << R"({"boards": [{"profile": "geeetech-a30t", "count": )" << boards << "}]}";
    }
    ~FleetFile() { std::filesystem::remove_all(folder_); }
    FleetFile(const FleetFile&) = delete;
    FleetFile& operator=(const FleetFile&) = delete;
    std::string path() const { return folder_ + "/fleet.json"; }

  private:
    std::string folder_;
};

/// Ten boards, one page open on one of them and the shelf on another.
std::vector<Figure> looked_at(const Settings& settings) {
    const FleetFile file(10);
    FleetChild fleet(settings.program, file.path(), {"--web"});
    const Address address(fleet.web());
    OpenPage page(address, 0);
    Looker shelf(address);
    shelf.get("shelf");
    std::atomic<bool> stop = false;
    std::thread reader([&] {
        while (!stop) {
            page.stream.read(100);
            shelf.read(1);
        }
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(settings.smoke ? 100 : 4000));
    const double before = fleet.cpu_seconds();
    const double seconds = settings.smoke ? 0.2 : 20;
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    const double share = (fleet.cpu_seconds() - before) / seconds * 100;
    stop = true;
    reader.join();
    return {{"ten idle boards, a page and the shelf open", "% of a core", share, {}, 2}};
}

/// A thousand boards, each on a terminal of its own.
std::vector<Figure> thousand(const Settings& settings) {
    const int boards = settings.smoke ? 20 : 1000;
    const FleetFile one(1);
    const FleetFile file(boards);
    double alone = 0;
    {
        FleetChild single(settings.program, one.path(), {});
        std::this_thread::sleep_for(std::chrono::milliseconds(settings.smoke ? 50 : 2000));
        alone = single.resident_bytes();
    }
    FleetChild fleet(settings.program, file.path(), {});
    std::this_thread::sleep_for(std::chrono::milliseconds(settings.smoke ? 100 : 5000));
    const double before = fleet.cpu_seconds();
    const double seconds = settings.smoke ? 0.2 : 20;
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    const double share = (fleet.cpu_seconds() - before) / seconds * 100 / boards;
    const double memory = (fleet.resident_bytes() - alone) / (boards - 1) / 1024;
    int silent = 0;
    for (const std::string& path : fleet.paths()) {
        Peer peer(path);
        peer.write(protocol::frame("M290 Z0.01"));
        silent += peer.line_within(reply_start, 2) ? 0 : 1;
    }
    return {{"many idle boards: processor time of each", "% of a core", share, {}, 0.05},
            {"many idle boards: memory of each", "KiB", memory, {}, 80},
            {"many idle boards: those that do not answer", "", static_cast<double>(silent), {}, 0}};
}

}  // namespace

std::vector<Benchmark> panel_benchmarks() {
    return {{"panel", "the panel while nobody looks, against a run without it", unseen},
            {"panel-flood", "the line while a client floods the page, against the quiet line of the same run",
             flooded},
            {"panel-open", "ten boards with one page and the shelf open", looked_at},
            {"fleet", "a thousand idle boards in one process", thousand}};
}

}  // namespace fauxboard::bench
