#include "emulator/behaviour/rule_compiler.h"

#include <algorithm>

#include <array>

#include "emulator/behaviour/nearest.h"

namespace fauxboard::behaviour {
namespace {

constexpr std::size_t most_listed = 6;     // names that a message has room for
constexpr std::size_t most_compared = 64;  // rules of a code, each with those before it: no list takes long

std::string below(const std::string& pointer, std::string_view key) {
    std::string out = pointer + "/";
    for (const char c : key) {
        out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    return out;
}

/// Calls `use` for the node, or for each of its items when it is a list.
template <class F>
void each(const Json& node, const std::string& pointer, F&& use) {
    if (!node.is_array()) {
        use(node, pointer);
        return;
    }
    for (std::size_t i = 0; i < node.size(); ++i) {
        use(node[i], pointer + "/" + std::to_string(i));
    }
}

bool is_reference(const std::string& text) {
    return text.size() > 2 && text.front() == '{' && text.back() == '}';
}

}  // namespace

Operand RuleCompiler::reference(std::string_view text, const std::string& pointer) {
    try {
        return parse_reference(text, names_);
    } catch (const ExpressionError& error) {
        findings_.add(pointer, error.what(), error.nearest);
        return {};
    }
}

bool RuleCompiler::literal(const Json& node, const std::string& pointer, Operand& out) {
    if (node.is_number()) {
        out = Operand::literal(node.get<double>());
    } else if (node.is_boolean()) {
        out = Operand::literal(node.get<bool>() ? 1.0 : 0.0);
    } else if (node.is_string()) {
        out = Operand::literal(node.get<std::string>());
    } else {
        findings_.add(pointer, found(node) + "; expected a number, true, false or a text");
        return false;
    }
    return true;
}

Operand RuleCompiler::value(const Json& node, const std::string& pointer) {
    if (node.is_string() && is_reference(node.get_ref<const std::string&>())) {
        const auto& text = node.get_ref<const std::string&>();
        return reference(std::string_view(text).substr(1, text.size() - 2), pointer);
    }
    Operand out;
    literal(node, pointer, out);
    return out;
}

std::vector<Condition> RuleCompiler::conditions(const Json& node, const std::string& pointer) {
    std::vector<Condition> out;
    if (!node.is_object()) {
        findings_.add(pointer,
                      found(node) + "; expected an object of conditions, such as {\"motion.homed\": true}");
        return out;
    }
    for (const auto& [key, test] : node.items()) {
        condition(key, test, below(pointer, key), out);
    }
    return out;
}

void RuleCompiler::condition(const std::string& left, const Json& node, const std::string& pointer,
                             std::vector<Condition>& out) {
    Condition base;
    base.left = reference(left, pointer);
    if (base.left.kind == Operand::Kind::none) {
        return;
    }
    if (node.is_object()) {
        condition_tests(base, left, node, pointer, out);
        return;
    }
    base.right.emplace_back();
    if (!compared(base.left, left, node, pointer, base.right[0])) {
        return;
    }
    check_reach(base.left, base.right[0], base.right[0], pointer);
    out.push_back(std::move(base));
}

/// What the left side is compared with: a text with a text, a number with a number.
bool RuleCompiler::compared(const Operand& left, const std::string& name, const Json& node,
                            const std::string& pointer, Operand& out) {
    if (!literal(node, pointer, out)) {
        return false;
    }
    if (left.is_text() != out.is_text()) {
        findings_.add(pointer,
                      found(node) + "; \"" + name + "\" is a " + (left.is_text() ? "text" : "number"));
        return false;
    }
    return true;
}

/// A setting that is never so high, or never so low. What is measured has no bounds.
void RuleCompiler::check_reach(const Operand& left, const Operand& min, const Operand& max,
                               const std::string& pointer) {
    if (left.kind != Operand::Kind::field || !left.field->is_bounded()) {
        return;
    }
    const Field& field = *left.field;
    const bool below = max.kind == Operand::Kind::number && max.number < field.min;
    if (below || (min.kind == Operand::Kind::number && min.number > field.max)) {
        findings_.add(pointer,
                      fmt::format("found {}; {} is from {} to {}: this never holds",
                                  below ? max.number : min.number, field.path, field.min, field.max));
    }
}

void RuleCompiler::condition_range(const Condition& base, const std::string& left, ObjectReader& reader,
                                   const std::string& pointer, std::vector<Condition>& out) {
    if (base.left.is_text()) {
        findings_.add(pointer, "\"" + left + "\" is a text, which min and max do not fit");
    }
    Condition c = base;
    c.test = Condition::Test::range;
    c.right.resize(2);
    for (const auto& [key, side] : {std::pair{"min", std::size_t{0}}, std::pair{"max", std::size_t{1}}}) {
        if (reader.has(key)) {
            double bound = 0;
            reader.number(key, bound, -1e15, 1e15);
            c.right[side] = Operand::literal(bound);
        }
    }
    const Operand& min = c.right[0];
    const Operand& max = c.right[1];
    if (min.kind != Operand::Kind::none && max.kind != Operand::Kind::none && min.number > max.number) {
        findings_.add(pointer,
                      fmt::format("min {} is above max {}: this never holds", min.number, max.number));
    } else {
        check_reach(base.left, min, max, pointer);
    }
    out.push_back(std::move(c));
}

void RuleCompiler::condition_tests(const Condition& base, const std::string& left, const Json& node,
                                   const std::string& pointer, std::vector<Condition>& out) {
    ObjectReader reader(node, pointer, findings_);
    if (reader.has("min") || reader.has("max")) {
        condition_range(base, left, reader, pointer, out);
    }
    if (reader.has("present")) {
        bool present = true;
        reader.boolean("present", present);
        Condition c = base;
        c.test = present ? Condition::Test::present : Condition::Test::absent;
        out.push_back(std::move(c));
    }
    if (const Json* item = reader.get("not")) {
        Condition c = base;
        c.test = Condition::Test::not_equal;
        c.right.emplace_back();
        if (compared(base.left, left, *item, reader.pointer("not"), c.right[0])) {
            out.push_back(std::move(c));
        }
    }
    if (const Json* list = reader.get("in")) {
        Condition c = base;
        c.test = Condition::Test::one_of;
        each(*list, reader.pointer("in"), [&](const Json& item, const std::string& at) {
            c.right.emplace_back();
            compared(base.left, left, item, at, c.right.back());
        });
        if (c.right.empty()) {
            findings_.add(reader.pointer("in"), "found an empty list: this never holds");
        }
        out.push_back(std::move(c));
    }
    if (reader.has("starts_with")) {
        std::string prefix;
        reader.text("starts_with", prefix);
        if (!base.left.is_text()) {
            findings_.add(reader.pointer("starts_with"),
                          "\"" + left + "\" is a number, which starts with nothing");
        }
        Condition c = base;
        c.test = Condition::Test::starts_with;
        c.right.push_back(Operand::literal(prefix));
        out.push_back(std::move(c));
    }
    reader.finish();
}

std::vector<ActionCall> RuleCompiler::actions(const Json& node, const std::string& pointer) {
    std::vector<ActionCall> out;
    each(node, pointer, [&](const Json& item, const std::string& at) {
        if (item.is_string()) {
            call(item.get<std::string>(), nullptr, at, out);
        } else if (item.is_object()) {
            for (const auto& [name, args] : item.items()) {
                call(name, &args, below(at, name), out);
            }
        } else {
            findings_.add(at, found(item) + "; expected an action: its name, or {\"name\": {arguments}}");
        }
    });
    return out;
}

void RuleCompiler::call(const std::string& name, const Json* args, const std::string& pointer,
                        std::vector<ActionCall>& out) {
    const ActionInfo* info = find_action(name);
    if (info == nullptr) {
        std::vector<std::string_view> names;
        for (const ActionInfo& action : behaviour::actions()) {
            names.push_back(action.name);
        }
        findings_.add(pointer, "unknown action \"" + name + '"', std::string(nearest(name, names)));
        return;
    }
    static const Json nothing = Json::object();
    const Json& given = args != nullptr ? *args : nothing;
    if (info->run == nullptr) {
        assignments(given, pointer, name == "add", out);
        return;
    }
    ActionCall compiled;
    compiled.info = info;
    compiled.args.resize(info->args.size());
    ObjectReader reader(given, pointer, findings_);
    for (std::size_t i = 0; i < info->args.size(); ++i) {
        const Json* arg = reader.get(info->args[i].name);
        if (arg != nullptr) {
            argument(info->args[i], *arg, reader.pointer(info->args[i].name), compiled.args[i]);
        } else if (info->args[i].required) {
            reader.required(info->args[i].name);
        }
    }
    reader.finish();
    out.push_back(std::move(compiled));
}

void RuleCompiler::argument(const ArgInfo& info, const Json& node, const std::string& pointer, Operand& out) {
    out = value(node, pointer);
    if (out.kind != Operand::Kind::none && out.is_text() != (info.type == ArgType::text)) {
        findings_.add(pointer,
                      found(node) + "; expected a " + (info.type == ArgType::text ? "text" : "number"));
    } else if (info.known != nullptr) {
        check_name(*info.known, out, pointer);
    } else if (out.kind == Operand::Kind::number && info.min <= info.max &&
               (out.number < info.min || out.number > info.max)) {
        findings_.add(pointer, fmt::format("found {}; expected {}, from {} to {}", out.number, info.help,
                                           info.min, info.max));
    }
}

void RuleCompiler::check_name(const KnownNames& known, const Operand& given, const std::string& pointer) {
    if (given.kind != Operand::Kind::text) {
        return;
    }
    const auto names = known.of(machine_);
    if (names && std::find(names->begin(), names->end(), given.text) == names->end()) {
        std::string message = fmt::format("unknown {} \"{}\"", known.what, given.text);
        if (names->size() <= most_listed) {
            message += fmt::format("; expected {}", fmt::join(*names, " or "));
        }
        findings_.add(pointer, message, std::string(nearest(given.text, *names)));
    }
}

void RuleCompiler::assignments(const Json& node, const std::string& pointer, bool add,
                               std::vector<ActionCall>& out) {
    if (!node.is_object()) {
        findings_.add(pointer, found(node) + "; expected an object of fields and their values");
        return;
    }
    for (const auto& [path, item] : node.items()) {
        const std::string at = below(pointer, path);
        const Operand target = reference(path, at);
        if (target.kind == Operand::Kind::none) {
            continue;
        }
        ActionCall compiled;
        compiled.info = find_action(add ? "add" : "set");
        compiled.add = add;
        compiled.args.push_back(value(item, at));
        if (target.kind == Operand::Kind::variable) {
            compiled.variable = target.variable;
        } else if (target.kind == Operand::Kind::field && target.field->set != nullptr) {
            compiled.field = target.field;
        } else {
            findings_.add(at, "\"" + path + "\" can be read but not set");
            continue;
        }
        if (compiled.args[0].kind != Operand::Kind::none && compiled.args[0].is_text() != target.is_text()) {
            findings_.add(at,
                          found(item) + "; \"" + path + "\" is a " + (target.is_text() ? "text" : "number"));
        }
        if (add && target.is_text()) {
            findings_.add(at, "\"" + path + "\" is a text; only numbers can be added to");
        }
        out.push_back(std::move(compiled));
    }
}

std::optional<std::size_t> RuleCompiler::frame(const Json& node, const std::string& pointer) {
    if (!node.is_string()) {
        findings_.add(pointer, found(node) + "; expected the name of a frame");
        return std::nullopt;
    }
    const auto& name = node.get_ref<const std::string&>();
    const auto hit = frames_.find(name);
    if (hit != frames_.end()) {
        return hit->second;
    }
    std::vector<std::string_view> names;
    for (const auto& [known, index] : frames_) {
        names.emplace_back(known);
    }
    findings_.add(pointer, "unknown frame \"" + name + "\"; expected one of the profile's `frames`",
                  std::string(nearest(name, names)));
    return std::nullopt;
}

Send RuleCompiler::send(const Json& node, const std::string& pointer) {
    Send out;
    if (!node.is_object()) {
        out.frame = frame(node, pointer).value_or(0);
        return out;
    }
    ObjectReader reader(node, pointer, findings_);
    reader.required("frame");
    if (const Json* name = reader.get("frame")) {
        out.frame = frame(*name, reader.pointer("frame")).value_or(0);
    }
    reader.unsigned_integer("times", out.times, 1, 20);
    reader.boolean("now", out.now);
    if (const Json* when = reader.get("when")) {
        out.when = conditions(*when, reader.pointer("when"));
    }
    reader.finish();
    return out;
}

std::vector<Send> RuleCompiler::sends(const Json& node, const std::string& pointer) {
    std::vector<Send> out;
    each(node, pointer, [&](const Json& item, const std::string& at) { out.push_back(send(item, at)); });
    return out;
}

Rule RuleCompiler::rule(const Json& node, const std::string& pointer) {
    Rule out;
    ObjectReader reader(node, pointer, findings_);
    if (const Json* when = reader.get("when")) {
        out.when = conditions(*when, reader.pointer("when"));
    }
    if (const Json* todo = reader.get("do")) {
        out.actions = actions(*todo, reader.pointer("do"));
    }
    if (const Json* frames = reader.get("send")) {
        out.send = sends(*frames, reader.pointer("send"));
    }
    if (const Json* frames = reader.get("after")) {
        out.after = sends(*frames, reader.pointer("after"));
    }
    reader.boolean("at_once", out.at_once);
    reader.boolean("until_done", out.until_done);
    reader.finish();
    return out;
}

namespace {

/// Whether all that `less` asks for is asked for by `more`, too.
bool asks_less(const Json& less, const Json& more) {
    return std::all_of(less.items().begin(), less.items().end(), [&](const auto& item) {
        const auto hit = more.is_object() ? more.find(item.key()) : more.end();
        return hit != more.end() && *hit == item.value();
    });
}

}  // namespace

std::vector<Rule> RuleCompiler::rules(const Json& node, const std::string& pointer) {
    std::vector<Rule> out;
    std::vector<std::pair<const Json*, std::string>> before;  // what they ask for, and where they stand
    each(node, pointer, [&](const Json& item, const std::string& at) {
        static const Json nothing = Json::object();
        const Json* when = item.is_object() && item.contains("when") ? &item.at("when") : &nothing;
        // The first that holds is the one that is carried out.
        const auto hides = std::find_if(before.begin(), before.end(), [&](const auto& earlier) {
            return asks_less(*earlier.first, *when);
        });
        if (hides != before.end()) {
            findings_.add(at, fmt::format("this rule is never reached: {} holds {}", hides->second,
                                          hides->first->empty() ? "always" : "whenever this one does"));
        }
        out.push_back(rule(item, at));
        if (item.is_object() && when->is_object() && before.size() < most_compared) {
            before.emplace_back(when, at);
        }
    });
    return out;
}

}  // namespace fauxboard::behaviour
