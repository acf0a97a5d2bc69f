#include "emulator/script/loader.h"

#include <fmt/format.h>

#include <algorithm>

#include "emulator/behaviour/machine_loader.h"
#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/parse_json.h"
#include "emulator/script/compiler.h"
#include "emulator/script/placeholders.h"

namespace fauxboard::script {
namespace {

using behaviour::Document;
using behaviour::Findings;
using behaviour::found;
using behaviour::ObjectReader;
using behaviour::Problem;
using behaviour::ProfileError;

constexpr std::size_t most_depth = 8;
constexpr std::size_t most_files = 256;

using Values = std::map<std::string, Json, std::less<>>;

bool is_scalar(const Json& value) {
    return value.is_string() || value.is_number() || value.is_boolean();
}

/// What a person wrote behind "name=".
Json value_of_text(const std::string& text) {
    const Json json = behaviour::parse_json(text);
    return json.is_number() || json.is_boolean() ? json : Json(text);
}

/// The parameters of one file, with what was given for them.
class Parameters {
  public:
    Parameters(const Document& document, Findings& findings) : findings_(findings) {
        const auto node = document.root.find("parameters");
        if (node == document.root.end()) {
            return;
        }
        if (!node->is_object()) {
            findings_.add("/parameters", found(*node) + "; expected an object of parameters");
            return;
        }
        for (const auto& [name, spec] : node->items()) {
            declare(name, spec);
        }
    }

    /// Reports, as (message, nearest), a name that there is none of.
    template <class Report>
    void give(const Values& given, Report&& report) {
        for (const auto& [name, value] : given) {
            if (values_.contains(name)) {
                values_[name] = value;
                continue;
            }
            std::vector<std::string_view> names;
            for (const auto& [known, fallback] : values_)
                names.push_back(known);
            report(fmt::format("the scenario has no parameter \"{}\"{}", name,
                               names.empty() ? ", nor any other" : ""),
                   std::string(behaviour::nearest(name, names)));
        }
    }
    Json fill(const Json& node) {
        return filled(
            node,
            [this](std::string_view name) -> std::optional<Json> {
                const auto hit = values_.find(name);
                if (hit == values_.end()) {
                    return std::nullopt;
                }
                used_.emplace(name);
                return hit->second;
            },
            Escapes::keep, true);
    }
    void check_used() {
        for (const auto& [name, value] : values_) {
            if (!used_.contains(name)) {
                findings_.add(
                    "/parameters/" + name,
                    fmt::format("nothing uses the parameter \"{}\"; write ${{{}}} where it belongs, or "
                                "take it away",
                                name, name));
            }
        }
    }
    const Values& values() const { return values_; }

  private:
    void declare(const std::string& name, const Json& spec) {
        const std::string at = "/parameters/" + name;
        if (!is_name(name)) {
            findings_.add("/parameters",
                          fmt::format("\"{}\" is no name for a parameter; expected letters, digits and "
                                      "'_', no digit first",
                                      name));
            return;
        }
        ObjectReader reader(spec, at, findings_);
        std::string help;
        reader.required("help");
        reader.required("default");
        reader.text("help", help, 500);
        const Json* fallback = reader.get("default");
        reader.finish();
        values_[name] = "1";
        if (fallback == nullptr) {
            return;
        }
        if (is_scalar(*fallback)) {
            values_[name] = *fallback;
        } else {
            findings_.add(at + "/default", found(*fallback) + "; expected a text, a number, true or false");
        }
    }

    Findings& findings_;
    Values values_;
    std::set<std::string, std::less<>> used_;
};

void read_limits(const Json& node, Compiler& compiler, Findings& findings, Scenario::Limits& out) {
    constexpr SimTime shortest{1000};
    ObjectReader reader(node, "/limits", findings);
    if (const Json* wait = reader.get("wait")) {
        out.wait = compiler.time(*wait, "/limits/wait", shortest, Compiler::longest_limit);
    }
    if (const Json* expect = reader.get("expect")) {
        out.expect = compiler.time(*expect, "/limits/expect", shortest, Compiler::longest_limit);
    }
    reader.finish();
}

/// One loading, of a scenario and all that it includes.
class Loader {
  public:
    Loader(const behaviour::SourceFinder& find, const Cast& cast, Scenario& out)
        : find_(find), shared_(cast, out.limits), out_(out) {
        shared_.include = [this](const std::string& name, const std::string& from, const Json& arguments,
                                 Findings& findings, const std::string& pointer) {
            return include(name, from, arguments, findings, pointer);
        };
    }

    void main_file(const behaviour::SourceText& source, const Arguments& arguments);
    std::vector<Problem> problems;
    std::size_t steps() const { return shared_.steps; }

  private:
    Block include(const std::string& name, const std::string& from, const Json& arguments, Findings& findings,
                  const std::string& pointer);
    std::vector<Step> body(Parameters& parameters, Findings& findings,
                           const std::shared_ptr<const Document>& document, bool main);

    const behaviour::SourceFinder& find_;
    Shared shared_;
    Scenario& out_;
    std::vector<std::string> open_;  ///< files under way
};

void read_card(const Json& node, Findings& findings, const Cast& cast, Scenario& out) {
    machine::CardConfig card = cast.profile->machine->card;
    behaviour::load_card(node, "/card", findings, card);
    out.card = std::make_shared<const std::vector<machine::BuiltInEntry>>(std::move(card.entries));
}

std::vector<Step> Loader::body(Parameters& parameters, Findings& findings,
                               const std::shared_ptr<const Document>& document, bool main) {
    ObjectReader reader(document->root, "", findings);
    std::string text;
    reader.required("name");
    reader.text("name", main ? out_.name : text, 100);
    reader.text("title", main ? out_.title : text, 500);
    for (const char* key : {"profile", "screen"}) {
        reader.text(key, text, 4096);
    }
    reader.has("parameters");
    Compiler compiler(shared_, findings, document);
    const Scenario::Limits before = shared_.limits;
    if (const Json* limits = reader.get("limits")) {
        read_limits(parameters.fill(*limits), compiler, findings, shared_.limits);
    }
    if (const Json* card = reader.get("card")) {
        if (main) {
            read_card(parameters.fill(*card), findings, shared_.cast, out_);
        }
    }
    reader.required("steps");
    std::vector<Step> out;
    if (const Json* steps = reader.get("steps")) {
        out = compiler.steps(parameters.fill(*steps), "/steps");
    }
    reader.finish();
    parameters.check_used();
    shared_.limits = before;
    return out;
}

void Loader::main_file(const behaviour::SourceText& source, const Arguments& arguments) {
    const auto document = std::make_shared<const Document>(behaviour::parse_document(source));
    Findings findings{*document, {}};
    Parameters parameters(*document, findings);
    Values given;
    for (const auto& [name, text] : arguments) {
        given.emplace(name, value_of_text(text));
    }
    parameters.give(given, [&](std::string message, std::string nearest) {
        Problem problem;
        problem.file = "--param";
        problem.message = std::move(message);
        problem.nearest = std::move(nearest);
        findings.problems.push_back(std::move(problem));
    });
    open_.push_back(source.name);
    out_.files.push_back(source.name);
    out_.main.steps = body(parameters, findings, document, true);
    open_.pop_back();
    for (const auto& [name, value] : parameters.values()) {
        out_.parameters.emplace_back(name, value.dump());
    }
    problems.insert(problems.end(), findings.problems.begin(), findings.problems.end());
}

Block Loader::include(const std::string& name, const std::string& from, const Json& arguments,
                      Findings& findings, const std::string& pointer) {
    const auto source = find_(name, from);
    if (!source) {
        findings.add(
            pointer,
            fmt::format("there is no scenario \"{}\", neither beside this file nor among the shipped "
                        "ones",
                        name));
        return {};
    }
    if (std::find(open_.begin(), open_.end(), source->name) != open_.end()) {
        findings.add(pointer, "the scenarios include one another in a circle");
        return {};
    }
    if (open_.size() >= most_depth || out_.files.size() >= most_files) {
        findings.add(pointer, open_.size() >= most_depth
                                  ? "scenarios are included more than 8 deep"
                                  : fmt::format("more than {} scenarios are included", most_files));
        return {};
    }
    try {
        const auto document = std::make_shared<const Document>(behaviour::parse_document(*source));
        Findings inner{*document, {}};
        Parameters parameters(*document, inner);
        Values given;
        for (const auto& [key, value] : arguments.items()) {
            if (is_scalar(value)) {
                given.emplace(key, value);
            } else {  // its default stands for it
                findings.add(pointer,
                             fmt::format("the parameter \"{}\": {}; expected a text, a number, true or "
                                         "false",
                                         key, found(value)));
            }
        }
        parameters.give(given, [&](std::string message, std::string nearest) {
            findings.add(pointer, std::move(message), std::move(nearest));
        });
        open_.push_back(source->name);
        out_.files.push_back(source->name);
        Block out{name, body(parameters, inner, document, false)};
        open_.pop_back();
        findings.problems.insert(findings.problems.end(), inner.problems.begin(), inner.problems.end());
        return out;
    } catch (const ProfileError& error) {  // no JSON at all
        findings.problems.insert(findings.problems.end(), error.problems().begin(), error.problems().end());
        return {};
    }
}

}  // namespace

Head read_head(const behaviour::SourceText& source) {
    const Document document = behaviour::parse_document(source);
    Findings findings{document, {}};
    ObjectReader reader(document.root, "", findings);
    Head out;
    reader.text("name", out.name, 100);
    reader.text("title", out.title, 500);
    reader.text("profile", out.profile, 4096);
    reader.text("screen", out.screen, 4096);
    const Json* parameters = reader.get("parameters");
    for (std::size_t i = 0; parameters != nullptr && parameters->is_object() && i < parameters->size(); ++i) {
        const auto it = std::next(parameters->begin(), static_cast<std::ptrdiff_t>(i));
        if (it->is_object()) {
            const auto help = it->find("help");
            out.parameters.push_back(
                {it.key(), it->contains("default") ? (*it)["default"].dump() : "",
                 help != it->end() && help->is_string() ? help->get<std::string>() : ""});
        }
    }
    if (!findings.problems.empty()) {
        throw ProfileError(std::move(findings.problems));
    }
    return out;
}

std::shared_ptr<const Scenario> load_scenario(const behaviour::SourceText& source,
                                              const behaviour::SourceFinder& find, const Cast& cast,
                                              const Arguments& arguments) {
    auto out = std::make_shared<Scenario>();
    out->cast = cast;
    Loader loader(find, cast, *out);
    loader.main_file(source, arguments);
    if (!loader.problems.empty()) {
        throw ProfileError(std::move(loader.problems));
    }
    out->steps = loader.steps();
    return out;
}

}  // namespace fauxboard::script
