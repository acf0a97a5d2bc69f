#include "emulator/behaviour/lists.h"

#include <vector>

#include "emulator/behaviour/kind.h"
#include "emulator/behaviour/nearest.h"

namespace fauxboard::behaviour {
namespace {

template <class Row>
const Row* find(std::span<const Row> (*KindRow::*table)(), std::string_view path) {
    for (const KindRow* kind : kinds()) {
        if (kind->*table == nullptr) continue;
        for (const Row& row : (kind->*table)()) {
            if (row.path == path) return &row;
        }
    }
    return nullptr;
}

}  // namespace

const List* find_list(std::string_view path) {
    return find(&KindRow::lists, path);
}

const Picture* find_picture(std::string_view path) {
    return find(&KindRow::pictures, path);
}

std::string_view nearest_picture(std::string_view path) {
    std::vector<std::string_view> names;
    for (const KindRow* kind : kinds()) {
        if (kind->pictures == nullptr) continue;
        for (const Picture& picture : kind->pictures()) {
            names.push_back(picture.path);
        }
    }
    return nearest(path, names);
}

}  // namespace fauxboard::behaviour
