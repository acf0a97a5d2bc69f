// `fauxboard describe`: the reference, from the tables in the code.

#include <memory>
#include <vector>

#include "emulator/behaviour/parse_json.h"
#include "emulator/host/profile_files.h"
#include "tools/describe_reference.h"
#include "tools/profile_words.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

struct DescribeArguments {
    std::vector<std::string> words;
    std::string profile;  ///< whose words are among the codes; empty: none
    bool json = false;
    bool markdown = false;
    std::string schema;
};

ExitCode describe_schema(const std::string& file) {
    const auto source = host::read_source(file);
    const behaviour::Json schema = behaviour::parse_json(source ? source->text : std::string());
    if (!schema.is_object() || !schema.contains("definitions")) {
        return complain("describe", ExitCode::bad_input, file + ": no schema of profiles");
    }
    print(schema_text(refresh_schema(schema)));
    return ExitCode::ok;
}

ExitCode describe(const DescribeArguments& arguments) {
    if (!arguments.schema.empty()) {
        return describe_schema(arguments.schema);
    }
    if (arguments.markdown) {
        print(reference_markdown());
        return ExitCode::ok;
    }
    std::shared_ptr<const behaviour::Profile> profile;
    try {
        profile = arguments.profile.empty() ? nullptr : host::load_profile_by_name(arguments.profile);
    } catch (const behaviour::ProfileError& error) {
        return complain("describe", ExitCode::bad_input, error.what());
    }
    const Choice chosen = choose_reference(arguments.words, profile.get());
    if (!chosen.wrong.empty()) {
        return complain("describe", ExitCode::usage, chosen.wrong);
    }
    print(arguments.json ? chosen.reference.dump(2) + "\n" : reference_text(chosen.reference));
    return ExitCode::ok;
}

}  // namespace

void add_describe(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand("describe",
                                           "The reference: fields, actions, events, codes of the protocol, "
                                           "faults of line and printer, the control channel, "
                                           "scenarios");
    const auto arguments = std::make_shared<DescribeArguments>();
    command
        ->add_option(
            "WORD", arguments->words,
            "Parts (fields, actions, events, codes, faults, control, scenarios), or one of what they "
            "hold: heaters.nozzle.target, L3, motion.home, jam; all when none is named")
        ->type_name("fields|actions|events|codes|faults|control|scenarios");
    add_words_of(*command, arguments->profile);
    CLI::Option* json = command->add_flag("--json", arguments->json, "As a JSON object");
    CLI::Option* markdown = command->add_flag("--markdown", arguments->markdown,
                                              "All of it as the Markdown page profiles/REFERENCE.md");
    command
        ->add_option("--schema", arguments->schema,
                     "Print this schema of profiles with its generated part made anew")
        ->type_name("FILE")
        ->excludes(json)
        ->excludes(markdown);
    markdown->excludes(json);
    command->callback([arguments, &exit] { exit = describe(*arguments); });
}

}  // namespace fauxboard::tools
