// The generated files against the tables they were made from.

#include <doctest/doctest.h>

#include <algorithm>

#include "emulator/behaviour/actions.h"
#include "emulator/behaviour/fields.h"
#include "emulator/fault/kind.h"
#include "emulator/host/profile_files.h"
#include "emulator/machine/events.h"
#include "protocol/catalogue.h"
#include "tests/tools/helpers.h"
#include "tools/describe_reference.h"

using namespace fauxboard;
using tests::read_file;

TEST_CASE("describe: profiles/REFERENCE.md is what `describe --markdown` prints") {
    const bool same = read_file(FAUXBOARD_SOURCE_DIR "/profiles/REFERENCE.md") == tools::reference_markdown();
    CHECK_MESSAGE(same, "stale: fauxboard describe --markdown > profiles/REFERENCE.md");
}

TEST_CASE("describe: the schema's generated part is that of the tables") {
    const std::string text = read_file(FAUXBOARD_SOURCE_DIR "/profiles/schemas/profile.schema.json");
    const auto schema = nlohmann::ordered_json::parse(text);
    const bool same = tools::schema_text(tools::refresh_schema(schema)) == text;
    CHECK_MESSAGE(same, "stale: see the end of profiles/README.md");
}

TEST_CASE("describe: all rows are there, each with its words") {
    const auto reference = tools::reference_json(tools::reference_parts);
    CHECK(reference["fields"].size() == behaviour::fields().size());
    CHECK(reference["actions"].size() == behaviour::actions().size());
    CHECK(reference["events"].size() == machine::events().size());
    CHECK(reference["codes"].size() == protocol::catalogue().size());
    const std::string text = tools::reference_text(reference);
    for (const auto& [part, rows] : reference.items()) {
        if (part == "control" || part == "faults" || part == "scenarios") {
            continue;  // below
        }
        for (const auto& row : rows) {
            const std::string name = row.begin().value();
            CAPTURE(name);
            CHECK(text.find(" " + name) != std::string::npos);
            const bool described = !row.value("help", row.value("meaning", std::string{})).empty();
            CHECK(described);
        }
    }
}

TEST_CASE("describe: one field, group, code, action or fault by its name") {
    const auto text = [](const std::vector<std::string>& words) {
        const tools::Choice chosen = tools::choose_reference(words);
        return chosen.wrong.empty() ? tools::reference_text(chosen.reference) : chosen.wrong;
    };
    const std::string field = text({"heaters.nozzle.target"});
    CHECK(field.starts_with("FIELDS"));
    CHECK(std::count(field.begin(), field.end(), '\n') == 2);
    CHECK(text({"heaters.nozzle"}).find("heaters.nozzle.printed") != std::string::npos);
    CHECK(text({"heaters.nozzle"}).find("heaters.bed") == std::string::npos);
    CHECK(text({"L3"}).find("> L3") != std::string::npos);
    CHECK(text({"L3"}).find("> L30") == std::string::npos);
    CHECK(text({"motion.home"}).find("ACTIONS") == 0);
    CHECK(text({"jam"}).find("jam ") != std::string::npos);
    CHECK(text({"jam"}).find("thermistor_open") == std::string::npos);
    const std::string two = text({"events", "L3"});
    CHECK(two.starts_with("EVENTS"));
    CHECK(two.find("CODES") != std::string::npos);
    CHECK(text({"field"}) ==
          "there is no part, field, action, event, code or fault \"field\"; did you mean \"fields\"?");
    CHECK(text({"L3", "heaters.nozle"}).find("did you mean \"heaters.nozzle\"?") != std::string::npos);
}

TEST_CASE("describe: what a profile calls codes of its own is among the codes") {
    const auto a30 = host::load_profile_by_name("geeetech-a30");
    const auto text = [&](const std::string& word) {
        return tools::reference_text(tools::choose_reference({word}, a30.get()).reference);
    };
    CHECK(text("L18").find(
              "> L18 P26 S8 exception: message page, SD card removed: In the words of geeetech-a30.") !=
          std::string::npos);
    CHECK(text("L18").find("> L18       exception: ") != std::string::npos);
    CHECK(text("L18 P26 S8").find("S9") == std::string::npos);
    const auto mine = behaviour::load_profile(
        {"mine.json",
         R"({"name": "mine", "extends": "geeetech-a30t", "words": {"M2999": {"title": "blow", "fields": {"S": "power"}}}})"},
        host::profile_finder());
    const std::string own = tools::reference_text(tools::choose_reference({"M2999"}, mine.get()).reference);
    CHECK(own.find("< M2999     blow: In the words of mine.") != std::string::npos);
    CHECK(own.find("      S     text             power") != std::string::npos);
    CHECK(tools::choose_reference({"M2999"}).wrong != "");
}

TEST_CASE("describe: only the parts asked for") {
    const std::string_view part = "events";
    const auto reference = tools::reference_json({&part, 1});
    CHECK(reference.size() == 1);
    CHECK(reference.contains("events"));
    const std::string text = tools::reference_text(tools::reference_json({&part, 1}));
    CHECK(text.starts_with("EVENTS"));
    CHECK(text.find("FIELDS") == std::string::npos);
}

TEST_CASE("describe: every kind of fault and every attribute is there, for people and for programs") {
    const std::string_view part = "faults";
    const auto faults = tools::reference_json({&part, 1})["faults"];
    CHECK(faults["kinds"].size() == fault::kinds().size());
    CHECK(faults["common"].size() == fault::common_attributes().size());
    const std::string text = tools::reference_text(tools::reference_json({&part, 1}));
    const std::string page = tools::reference_markdown();
    CHECK(text.starts_with("FAULTS"));
    const auto check_attribute = [&](const fault::Attribute& attribute) {
        CAPTURE(attribute.name);
        CHECK(text.find("\n      " + std::string(attribute.name) + " ") != std::string::npos);
        CHECK(text.find(attribute.help) != std::string::npos);
        CHECK(page.find("| `" + std::string(attribute.name) + "` |") != std::string::npos);
    };
    for (const fault::Kind* kind : fault::kinds()) {
        CAPTURE(kind->name);
        CHECK(text.find("\n  " + std::string(kind->name) + " ") != std::string::npos);
        CHECK(text.find(kind->help) != std::string::npos);
        CHECK(page.find("**`" + std::string(kind->name) + "`** " + std::string(kind->help)) !=
              std::string::npos);
        for (const fault::Attribute& attribute : kind->attributes) {
            check_attribute(attribute);
        }
    }
    for (const fault::CommonAttribute& attribute : fault::common_attributes()) {
        check_attribute(attribute);
    }
    CHECK(faults["printer"]["kinds"].size() == machine::fault_rows().size());
    for (const fault::Kind* kind : fault::printer_kinds()) {
        CAPTURE(kind->name);
        CHECK(text.find("\n  " + std::string(kind->name) + " ") != std::string::npos);
        CHECK(text.find(kind->help) != std::string::npos);
        CHECK(page.find("**`" + std::string(kind->name) + "`** " + std::string(kind->help)) !=
              std::string::npos);
        for (const fault::Attribute& attribute : kind->attributes) {
            check_attribute(attribute);
        }
    }
}

TEST_CASE("describe: the control channel's ops, topics and errors are all there") {
    const auto control = tools::reference_json(tools::reference_parts)["control"];
    const std::string text = tools::reference_text(tools::reference_json(tools::reference_parts));
    const std::string page = tools::reference_markdown();
    for (const auto* table : {"ops", "topics", "errors"}) {
        CHECK(control[table].size() > 3);
        for (const auto& row : control[table]) {
            const auto name = row.begin().value().get<std::string>();
            CAPTURE(name);
            CHECK(text.find("  " + name + " ") != std::string::npos);
            CHECK(page.find("| `" + name + "` |") != std::string::npos);
            CHECK_FALSE(row["help"].get<std::string>().empty());
        }
    }
}
