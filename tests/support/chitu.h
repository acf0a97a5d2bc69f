#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/resin_file.h"
#include "tests/support/sliced_file.h"

namespace fauxboard::testing {

/// A request of a ChiTu board and the bytes that come back; see tests/vectors/chitu*.json.
struct ChituVector {
    struct Preparation {
        std::string send;  ///< with its line end
        double wait_s = 0;
    };
    std::string name;
    bool stick = true;  ///< the stick of the seed's list is in
    std::vector<Preparation> prepare;
    std::string send;    ///< with its line end
    std::string reply;   ///< all of it
    double after_s = 0;  ///< when `state` holds
    std::map<std::string, double> state;
    std::map<std::string, std::string> texts;
    std::map<std::string, std::string> files;  ///< texts that stand on the stick then
};

struct ChituVectors {
    std::string profile;
    std::vector<ChituVector> vectors;
};

/// Reads tests/vectors/<name>.json; throws when it is wrong.
ChituVectors load_chitu_vectors(std::string_view name);

/// The file of the stick that can be printed, and its size.
inline constexpr const char* seed_file = "_Flexi-Rex-improved_sla.ctb";
inline constexpr std::uint64_t seed_file_bytes = 29771388;
/// How its layers are.
ResinFile seed_wishes();
const MadeResinFile& seed_content();

/// A folder of this computer with the files that an Elegoo Mars Pro listed, their sizes, and one more folder.
/// Sparse.
void make_seed_stick(const std::string& folder);
/// The same of a disk in memory, without the folder; it can be written to.
void put_seed_stick(MemoryDisk& disk);

}  // namespace fauxboard::testing
