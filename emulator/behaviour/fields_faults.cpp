// What is broken at the machine: a field for each sort of fault, and what every board shows of it.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "emulator/behaviour/field_rows.h"
#include "emulator/behaviour/field_tables.h"

namespace fauxboard::behaviour::rows {
namespace {

using machine::Machine;
using enum FieldType;

constexpr FieldRows<Machine> row;

constexpr std::array shown_rows{
    row.shown("host.active", boolean, "", "the USB side was heard within the last 10 s",
              [](const Machine& p) { return p.host_active(); }),
    row.shown("board.hung", boolean, "", "the board's program stands still: it hears and says nothing",
              [](const Machine& p) { return p.hung(); }),
};

/// Sorts of faults that the kinds of machines may have together: a field's getter is made for each in
/// advance.
constexpr std::size_t most_sorts = 128;

using Getter = Value (*)(const Machine&);

template <std::size_t I>
Value active(const Machine& machine) {
    return as_value(machine.faults.active(*machine::fault_rows()[I]));
}

template <std::size_t... I>
constexpr std::array<Getter, sizeof...(I)> make_getters(std::index_sequence<I...>) {
    return {active<I>...};
}
constexpr auto getters = make_getters(std::make_index_sequence<most_sorts>());

}  // namespace

std::span<const Field> fault_fields() {
    // Paths are made of the names in the machine's tables, and live as long as the program.
    static const std::vector<std::string> paths = [] {
        std::vector<std::string> made;
        for (const machine::FaultInfo* info : machine::fault_rows()) {
            made.push_back("faults." + std::string(info->name));
        }
        return made;
    }();
    static const std::vector<Field> table = [] {
        std::vector<Field> rows(shown_rows.begin(), shown_rows.end());
        for (std::size_t i = 0; i < paths.size(); ++i) {
            rows.push_back(
                {paths[i], boolean, "", 0, 0, false, machine::fault_rows()[i]->help, getters.at(i), nullptr});
        }
        return rows;
    }();
    return table;
}

}  // namespace fauxboard::behaviour::rows
