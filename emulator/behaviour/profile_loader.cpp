#include <algorithm>
#include <array>
#include <utility>

#include "emulator/behaviour/frame_loader.h"
#include "emulator/behaviour/kind.h"
#include "emulator/behaviour/line_loader.h"
#include "emulator/behaviour/machine_loader.h"
#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/profile.h"
#include "emulator/behaviour/reader.h"
#include "emulator/behaviour/rule_compiler.h"
#include "protocol/command.h"

namespace fauxboard::behaviour {
namespace {

using FrameIndex = std::map<std::string, std::size_t, std::less<>>;

/// Compiles a whole document into a Profile. The order of the steps is the order of need: names before what
/// uses them.
class Loader {
  public:
    explicit Loader(const Document& document) : document_(document), findings_{document, {}} {}

    std::shared_ptr<const Profile> load();

  private:
    void load_head(ObjectReader& root);
    void load_words(const Json& node, const std::string& pointer);
    void load_variables(const Json& node, const std::string& pointer);
    void name_frames(const Json& node, const std::string& pointer);
    void load_schedule(const Json& node, const std::string& pointer);
    void load_slot(const Json& node, const std::string& pointer);
    std::vector<std::size_t> watch(const Json& node, const std::string& pointer, std::size_t frame);
    void load_requests(const Json& node, const std::string& pointer, Profile::RequestTable& table);
    void load_events(const Json& node, const std::string& pointer);
    void load_defaults(const Json& node, const std::string& pointer);

    const Document& document_;
    Findings findings_;
    Names names_;
    Names request_names_;
    FrameIndex frame_index_;
    protocol::FrameStyle style_{};  ///< of frames that do not say theirs
    std::shared_ptr<Profile> profile_ = std::make_shared<Profile>();
    std::shared_ptr<machine::MachineConfig> machine_;
};

void Loader::load_head(ObjectReader& root) {
    root.required("name");
    root.text("name", profile_->name, 64);
    root.text("title", profile_->title, 256);
    root.text("screen", profile_->screen, 256);
    root.get("extends");  // resolved before
    constexpr std::array<std::string_view, 3> protocols{"smartto", "gcode", "marlin"};
    std::size_t protocol = 0;
    root.required("protocol");
    root.choice("protocol", protocols, protocol);
    profile_->line.framing = static_cast<Framing>(protocol);
    bool framed = protocol == 0;
    if (const Json* line = root.get("line")) {
        load_line(*line, root.pointer("line"), findings_, profile_->line, framed);
    }
    profile_->line.framed = framed;
    style_ = framed ? protocol::FrameStyle::framed : protocol::FrameStyle::bare;
    if (const Json* transmit = root.get("transmit")) {
        load_transmit(*transmit, root.pointer("transmit"), findings_, *profile_);
    }
}

/// {"M2999": "blow", "L30": {"title": "air", "fields": {"V": "VOC, ppm"}}}
void Loader::load_words(const Json& node, const std::string& pointer) {
    constexpr std::size_t longest = 64;  // of what is named
    constexpr std::size_t most_words = 128;
    if (!node.is_object()) {
        findings_.add(pointer, found(node) + "; expected an object of codes and their words");
        return;
    }
    ObjectReader all(node, pointer, findings_);
    for (const auto& [key, value] : node.items()) {
        CodeWords words;
        const std::string at = all.pointer(key);
        if (key.empty() || key.size() > longest || key.front() == ' ' || key.back() == ' ') {
            findings_.add(
                at,
                "expected the beginning of a line: a code, perhaps with parameters, of up to 64 characters");
        }
        if (value.is_string()) {
            all.text(key, words.title, most_words);
        } else {
            ObjectReader one(value, at, findings_);
            one.required("title");
            one.text("title", words.title, most_words);
            if (const Json* fields = one.get("fields")) {
                ObjectReader names(*fields, one.pointer("fields"), findings_);
                for (const auto& [letter, name] : fields->items()) {
                    names.text(letter, words.fields[letter], longest);
                }
            }
            one.finish();
        }
        profile_->words.emplace(key, std::move(words));
    }
}

void Loader::load_variables(const Json& node, const std::string& pointer) {
    ObjectReader all(node, pointer, findings_);
    if (!node.is_object()) {
        return;
    }
    for (const auto& [name, value] : node.items()) {
        if (name == "comment") {
            continue;
        }
        VariableInfo info;
        info.name = name;
        info.max = 1;
        ObjectReader reader(value, all.pointer(name), findings_);
        reader.number("min", info.min, -1e12, 1e12);
        reader.number("max", info.max, -1e12, 1e12);
        reader.number("value", info.initial, std::min(info.min, info.max), std::max(info.min, info.max));
        reader.text("help", info.help);
        reader.boolean("stored", info.stored);
        reader.finish();
        if (info.min > info.max) {
            findings_.add(all.pointer(name), "min is above max");
            std::swap(info.min, info.max);
        }
        names_.variables.emplace(name, profile_->variables.size());
        profile_->variables.push_back(std::move(info));
    }
}

void Loader::name_frames(const Json& node, const std::string& pointer) {
    const ObjectReader all(node, pointer, findings_);
    if (!node.is_object()) {
        return;
    }
    for (const auto& [name, value] : node.items()) {
        if (name == "comment") {
            continue;
        }
        frame_index_.emplace(name, profile_->frames.size());
        profile_->frames.emplace_back().name = name;
    }
}

std::vector<std::size_t> Loader::watch(const Json& node, const std::string& pointer, std::size_t frame) {
    std::vector<std::size_t> out;
    if (!node.is_array()) {
        findings_.add(pointer, found(node) + "; expected a list of fields");
        return out;
    }
    std::vector<const Field*>& watched = profile_->frames[frame].watched;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const std::string path = node[i].is_string() ? node[i].get<std::string>() : std::string{};
        const Field* field = find_field(path);
        if (field == nullptr || field->type == FieldType::text) {
            findings_.add(pointer + "/" + std::to_string(i),
                          found(node[i]) + "; expected the path of a numeric field",
                          std::string(nearest_field(path)));
            continue;
        }
        const auto known = std::find(watched.begin(), watched.end(), field);
        out.push_back(static_cast<std::size_t>(known - watched.begin()));
        if (known == watched.end()) {
            watched.push_back(field);
        }
    }
    return out;
}

void Loader::load_slot(const Json& node, const std::string& pointer) {
    Slot slot;
    if (node.is_null()) {
        profile_->schedule.slots.push_back(std::move(slot));
        return;
    }
    RuleCompiler compiler(findings_, names_, frame_index_, *machine_);
    ObjectReader reader(node, pointer, findings_);
    reader.required("send");
    if (const Json* send = reader.get("send")) {
        slot.frame = compiler.frame(*send, reader.pointer("send"));
    }
    reader.unsigned_integer("every_rounds", slot.every_rounds, 1, 1000);
    reader.unsigned_integer("first_round", slot.first_round, 0, 1000);
    const Json* when = reader.get("when");
    const Json* changed = reader.get("when_changed");
    if (when != nullptr) {
        slot.when = compiler.conditions(*when, reader.pointer("when"));
    }
    if (slot.frame) {
        if (changed != nullptr) {
            slot.when_changed = watch(*changed, reader.pointer("when_changed"), *slot.frame);
        }
        if (const Json* also = reader.get("or_changed")) {
            slot.or_changed = watch(*also, reader.pointer("or_changed"), *slot.frame);
        }
    }
    if (const Json* with = reader.get("only_with")) {
        slot.only_with = compiler.frame(*with, reader.pointer("only_with"));
    }
    reader.boolean("now", slot.now);
    reader.boolean("starts_told", slot.starts_told);
    slot.always = when == nullptr && changed == nullptr && !slot.only_with;
    reader.finish();
    profile_->schedule.slots.push_back(std::move(slot));
}

void Loader::load_schedule(const Json& node, const std::string& pointer) {
    Schedule& schedule = profile_->schedule;
    ObjectReader reader(node, pointer, findings_);
    double slot_ms = 300;
    double first_ms = 0;
    reader.number("slot_ms", slot_ms, 1, 600'000);
    reader.number("first_slot_ms", first_ms, 0, 600'000);
    schedule.slot = machine::from_seconds(slot_ms / 1000);
    schedule.first = machine::from_seconds(first_ms / 1000);
    if (const Json* frozen = reader.get("frozen_while")) {
        RuleCompiler compiler(findings_, names_, frame_index_, *machine_);
        const std::string at = reader.pointer("frozen_while");
        const std::size_t ways = frozen->is_array() ? frozen->size() : 1;
        for (std::size_t i = 0; i < ways; ++i) {
            schedule.frozen_while.push_back(
                frozen->is_array() ? compiler.conditions((*frozen)[i], at + "/" + std::to_string(i))
                                   : compiler.conditions(*frozen, at));
        }
    }
    if (const Json* slots = reader.get("slots")) {
        if (!slots->is_array() || slots->size() > 256) {
            findings_.add(reader.pointer("slots"), found(*slots) + "; expected a list of at most 256 slots");
        } else {
            for (std::size_t i = 0; i < slots->size(); ++i) {
                load_slot((*slots)[i], reader.pointer("slots") + "/" + std::to_string(i));
            }
        }
    }
    reader.finish();
}

void Loader::load_requests(const Json& node, const std::string& pointer, Profile::RequestTable& table) {
    RuleCompiler compiler(findings_, request_names_, frame_index_, *machine_);
    ObjectReader reader(node, pointer, findings_);
    if (!node.is_object()) {
        return;
    }
    for (const auto& [key, value] : node.items()) {
        if (key == "comment") {
            continue;
        }
        const std::string at = reader.pointer(key);
        const auto command = protocol::parse_command(key);
        if (!command || command->word.size() != key.size()) {
            findings_.add(at, "\"" + key + "\" is no code (M290) and no single word (log)");
            continue;
        }
        std::vector<Rule> rules = compiler.rules(value, at);
        if (command->letter == 'M' &&
            std::any_of(rules.begin(), rules.end(), [](const Rule& rule) { return rule.at_once; })) {
            profile_->urgent.push_back(std::to_string(command->number));
        }
        if (command->letter != 0) {
            table.codes[Profile::code_key(command->letter, command->number)] = std::move(rules);
        } else {
            table.words[key] = std::move(rules);
        }
    }
}

void Loader::load_events(const Json& node, const std::string& pointer) {
    RuleCompiler compiler(findings_, names_, frame_index_, *machine_);
    ObjectReader reader(node, pointer, findings_);
    for (const machine::EventId event : machine::events()) {
        if (const Json* said = reader.get(event->name)) {
            std::vector<Rule> rules = compiler.rules(*said, reader.pointer(event->name));
            // What a base says of another kind's events is checked, and has no effect.
            if (machine::has_event(*profile_->kind, event)) {
                profile_->events[machine::event_index(*profile_->kind, event)] = std::move(rules);
            }
        }
    }
    reader.finish();
}

void Loader::load_defaults(const Json& node, const std::string& pointer) {
    RuleCompiler compiler(findings_, names_, frame_index_, *machine_);
    compiler.assignments(node, pointer, false, profile_->defaults);
}

std::shared_ptr<const Profile> Loader::load() {
    ObjectReader root(document_.root, "", findings_);
    profile_->files = document_.files;
    load_head(root);
    const auto section = [&](std::string_view key, auto&& load) {
        if (const Json* node = root.get(key)) {
            load(*node, root.pointer(key));
        }
    };
    const LoadedMachine machine = load_machine(root.get("machine"), root.pointer("machine"), findings_);
    profile_->kind = machine.kind;
    machine_ = machine.config;
    section("identity",
            [&](const Json& n, const std::string& p) { load_identity(n, p, findings_, machine_->identity); });
    section("words", [&](const Json& n, const std::string& p) { load_words(n, p); });
    section("variables", [&](const Json& n, const std::string& p) { load_variables(n, p); });
    request_names_ = names_;
    request_names_.request = true;
    root.required("frames");
    section("frames", [&](const Json& n, const std::string& p) { name_frames(n, p); });
    section("frames", [&](const Json& n, const std::string& p) {
        if (!n.is_object()) {
            return;  // told already
        }
        ObjectReader frames(n, p, findings_);
        const bool commands = profile_->line.framing == Framing::commands;
        const FrameContext context{n,
                                   frame_index_,
                                   names_,
                                   request_names_,
                                   *machine_,
                                   style_,
                                   commands ? protocol::LineEnd::lf : protocol::LineEnd::crlf};
        FrameLoader loader(findings_, context);
        // In the order of the object, each where it stands: looking them up would be slow for very many.
        for (const auto& [name, value] : n.items()) {
            if (const auto at = frame_index_.find(name); at != frame_index_.end()) {
                loader.load(value, frames.pointer(name), profile_->frames[at->second]);
            }
        }
        profile_->code_cells = loader.cells();
    });
    section("defaults", [&](const Json& n, const std::string& p) { load_defaults(n, p); });
    section("boot", [&](const Json& n, const std::string& p) {
        profile_->boot = RuleCompiler(findings_, names_, frame_index_, *machine_).sends(n, p);
    });
    section("schedule", [&](const Json& n, const std::string& p) { load_schedule(n, p); });
    section("requests",
            [&](const Json& n, const std::string& p) { load_requests(n, p, profile_->requests); });
    section("host_requests",
            [&](const Json& n, const std::string& p) { load_requests(n, p, profile_->host_requests); });
    profile_->events.resize(machine::events_of(*profile_->kind).size());
    section("events", [&](const Json& n, const std::string& p) { load_events(n, p); });
    root.finish();
    if (!findings_.problems.empty()) {
        throw ProfileError(std::move(findings_.problems));
    }
    profile_->machine = machine_;
    return profile_;
}

}  // namespace

std::shared_ptr<const Profile> load_profile(const SourceText& source, const SourceFinder& find) {
    const Document document = load_document(source, find);
    return Loader(document).load();
}

}  // namespace fauxboard::behaviour
