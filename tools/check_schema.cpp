// JSON Schema, by valijson. Alone in this file because of what its headers cost.

#include <algorithm>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "tools/check_files.h"

namespace fauxboard::tools {
namespace {

/// valijson's way to a value, "<root>" "[frames]" "[L2]", as a JSON pointer.
std::string pointer_of(const std::vector<std::string>& context) {
    std::string out;
    for (const std::string& part : context) {
        if (part.size() < 2 || part.front() != '[') {
            continue;
        }
        out += '/';
        for (const char c : part.substr(1, part.size() - 2)) {
            out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
        }
    }
    return out;
}

bool is_inside(const std::string& inner, const std::string& outer) {
    return inner.size() > outer.size() && inner.starts_with(outer) && inner[outer.size()] == '/';
}

/// An error is also told of everything around it, and once for each branch tried: what helps is the innermost
/// place, and there the first sentence.
std::vector<SchemaError> innermost(const std::vector<SchemaError>& all) {
    std::vector<SchemaError> out;
    for (const SchemaError& error : all) {
        const bool outer = std::any_of(all.begin(), all.end(), [&](const SchemaError& other) {
            return is_inside(other.pointer, error.pointer);
        });
        const bool known = std::any_of(
            out.begin(), out.end(), [&](const SchemaError& other) { return other.pointer == error.pointer; });
        if (!outer && !known) {
            out.push_back(error);
        }
    }
    return out;
}

}  // namespace

std::vector<SchemaError> check_schema(const nlohmann::json& schema, const nlohmann::json& document) {
    valijson::Schema compiled;
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema), compiled);
    valijson::ValidationResults results;
    valijson::Validator validator;
    if (validator.validate(compiled, valijson::adapters::NlohmannJsonAdapter(document), &results)) {
        return {};
    }
    std::vector<SchemaError> all;
    for (const auto& error : results) {
        all.push_back({pointer_of(error.context), error.description});
    }
    return innermost(all);
}

}  // namespace fauxboard::tools
