#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "emulator/script/scenario.h"

namespace fauxboard::script {

/// What must be known of a scenario before it can be checked: which board and screen it is for.
struct Head {
    std::string name;
    std::string title;
    std::string profile;  ///< empty: it does not say
    std::string screen;   ///< empty: none in this process
    /// What it can be told, for lists: name, default as JSON, help.
    struct Parameter {
        std::string name;
        std::string fallback;
        std::string help;
    };
    std::vector<Parameter> parameters;
};
/// Throws behaviour::ProfileError when the text is no JSON or these keys are wrong.
Head read_head(const behaviour::SourceText& source);

/// Values of parameters, by name, as a person writes them: JSON's numbers, true and false are that, all else
/// is text.
using Arguments = std::map<std::string, std::string>;

/// Checks everything and compiles: nothing of it is sent before. Throws behaviour::ProfileError with all that
/// is wrong.
std::shared_ptr<const Scenario> load_scenario(const behaviour::SourceText& source,
                                              const behaviour::SourceFinder& find, const Cast& cast,
                                              const Arguments& arguments = {});

}  // namespace fauxboard::script
