#include "tools/fleet_file.h"

#include <fmt/format.h>

#include <array>
#include <set>

#include "emulator/behaviour/reader.h"
#include "emulator/fault/spec.h"
#include "emulator/host/profile_files.h"

namespace fauxboard::tools {
namespace {

using behaviour::Findings;
using behaviour::Json;
using behaviour::ObjectReader;

constexpr std::string_view number_mark = "{n}";

/// A text of a group: a board's own has its number in it.
struct TextKey {
    std::string_view key;
    std::string& (*of)(RunOptions&);
    bool own;  ///< two boards cannot share it
};
constexpr std::array text_keys{
    TextKey{"profile", [](RunOptions& o) -> std::string& { return o.profile; }, false},
    TextKey{"pty", [](RunOptions& o) -> std::string& { return o.pty_name; }, true},
    TextKey{"port", [](RunOptions& o) -> std::string& { return o.port; }, true},
    TextKey{"tcp", [](RunOptions& o) -> std::string& { return o.tcp; }, false},
    TextKey{"udp", [](RunOptions& o) -> std::string& { return o.udp; }, false},
    TextKey{"host_pty", [](RunOptions& o) -> std::string& { return o.host.pty_name; }, true},
    TextKey{"host_port", [](RunOptions& o) -> std::string& { return o.host.port; }, true},
    TextKey{"host_tcp", [](RunOptions& o) -> std::string& { return o.host.tcp; }, false},
    TextKey{"sd", [](RunOptions& o) -> std::string& { return o.sd; }, false},
    TextKey{"udisk", [](RunOptions& o) -> std::string& { return o.udisk; }, false},
    TextKey{"eeprom", [](RunOptions& o) -> std::string& { return o.eeprom; }, true},
    TextKey{"control", [](RunOptions& o) -> std::string& { return o.control; }, true},
};

std::string with_number(std::string text, unsigned number) {
    const std::string digits = std::to_string(number);
    for (std::size_t at = text.find(number_mark); at != std::string::npos;
         at = text.find(number_mark, at + digits.size())) {
        text.replace(at, number_mark.size(), digits);
    }
    return text;
}

class Reader {
  public:
    explicit Reader(const behaviour::Document& document) : findings_{document, {}} {}

    Fleet read() {
        ObjectReader root(findings_.document.root, "", findings_);
        root.required("boards");
        const Json* groups = root.get("boards");
        if (groups != nullptr && !groups->is_array()) {
            findings_.add("/boards", behaviour::found(*groups) + "; expected a list of boards");
        } else if (groups != nullptr) {
            for (std::size_t i = 0; i < groups->size(); ++i) {
                read_group((*groups)[i], fmt::format("/boards/{}", i));
            }
        }
        root.finish();
        if (findings_.problems.empty() && fleet_.boards.empty()) {
            findings_.add("/boards", "a fleet without a board");
        }
        if (!findings_.problems.empty()) {
            throw behaviour::ProfileError(findings_.problems);
        }
        return std::move(fleet_);
    }

  private:
    void read_group(const Json& node, const std::string& pointer) {
        ObjectReader group(node, pointer, findings_);
        unsigned count = 1;
        unsigned seed = 1;
        std::string name;
        RunOptions options;
        group.unsigned_integer("count", count, 1, Fleet::most_boards);
        group.unsigned_integer("seed", seed, 0, 4'000'000'000U);
        group.text("name", name, 128);
        group.boolean("pacing", options.pacing);
        for (const TextKey& each : text_keys) {
            std::string& text = each.of(options);
            group.text(each.key, text);
            if (each.own && count > 1 && !text.empty() && text.find(number_mark) == std::string::npos) {
                findings_.add(
                    group.pointer(each.key),
                    fmt::format("\"{}\" cannot be shared by {} boards; put {{n}} in it, which is the number "
                                "of each",
                                text, count));
            }
        }
        options.host.pty = !options.host.pty_name.empty();
        check_lines(options, pointer);
        read_faults(group, options);
        group.finish();
        if (!findings_.problems.empty()) {
            return;
        }
        for (unsigned n = 1; n <= count && take_name(options, name, n, count, pointer); ++n) {
            FleetBoard& board = fleet_.boards.back();
            for (const TextKey& each : text_keys) {
                each.of(board.options) = with_number(each.of(options), n);
            }
            board.options.seed = seed + n - 1;
        }
    }

    /// One more board with a name of its own.
    bool take_name(const RunOptions& options, const std::string& name, unsigned number, unsigned count,
                   const std::string& pointer) {
        std::string own = name.empty() ? options.profile : with_number(name, number);
        if (count > 1 && name.find(number_mark) == std::string::npos) {
            own += fmt::format("-{}", number);
        }
        if (fleet_.boards.size() == Fleet::most_boards) {
            findings_.add(pointer, fmt::format("more than {} boards", Fleet::most_boards));
            return false;
        }
        if (!names_.insert(own).second) {
            findings_.add(pointer, fmt::format("a second board of the name \"{}\"; give it a \"name\"", own));
            return false;
        }
        fleet_.boards.push_back({std::move(own), options});
        return true;
    }

    void check_lines(const RunOptions& options, const std::string& pointer) {
        if (!options.pty_name.empty() + !options.port.empty() + !options.tcp.empty() > 1) {
            findings_.add(pointer, "a board has one main line: expected one of pty, port and tcp");
        }
        if (!options.host.pty_name.empty() + !options.host.port.empty() + !options.host.tcp.empty() > 1) {
            findings_.add(pointer,
                          "a board has one USB port: expected one of host_pty, host_port and host_tcp");
        }
    }

    void read_faults(ObjectReader& group, RunOptions& options) {
        const Json* list = group.get("faults");
        if (list == nullptr) {
            return;
        }
        if (!list->is_array()) {
            findings_.add(group.pointer("faults"), behaviour::found(*list) + "; expected a list of texts");
            return;
        }
        for (std::size_t i = 0; i < list->size(); ++i) {
            const std::string place = fmt::format("{}/{}", group.pointer("faults"), i);
            try {
                (void)fault::fault_from_json((*list)[i]);
                options.faults.push_back((*list)[i].is_string()
                                             ? (*list)[i].get<std::string>()
                                             : fault::fault_to_text(fault::fault_from_json((*list)[i])));
            } catch (const fault::FaultSpecError& error) {
                findings_.add(place, error.what());
            }
        }
    }

    Findings findings_;
    Fleet fleet_;
    std::set<std::string, std::less<>> names_;
};

}  // namespace

Fleet read_fleet(const behaviour::SourceText& source) {
    const behaviour::Document document = behaviour::parse_document(source);
    return Reader(document).read();
}

Fleet read_fleet(const std::string& file) {
    const auto source = host::profile_finder()(file.find('/') == std::string::npos ? "./" + file : file, {});
    if (!source) {
        behaviour::Problem problem;
        problem.file = file;
        problem.message = "there is no such file";
        throw behaviour::ProfileError({problem});
    }
    return read_fleet(*source);
}

}  // namespace fauxboard::tools
