#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::testing {

/// One vector of tests/vectors/*.json; see the file's "about".
struct Vector {
    struct Preparation {
        std::string send;
        double wait_s = 0;
    };
    std::string button;
    std::vector<Preparation> prepare;
    std::string world;                 ///< done to the machine after `prepare`; empty: nothing
    std::vector<std::string> send;     ///< bodies
    std::vector<std::string> frame;    ///< the same as on the wire
    std::vector<std::string> host;     ///< instead of `send`: lines on the USB side
    std::vector<std::string> replies;  ///< as said() gives them
    bool paced = false;                ///< so only where the board's queue is in use
    std::set<std::size_t> direct;      ///< of them, those that are not queued
    std::map<std::string, double> state;
    std::map<std::string, std::string> texts;  ///< state of text fields
    double after_s = 2;
    double takes_s = 0;  ///< so long the board is at it before it answers
};

struct VectorFile {
    std::string profile;
    bool bare = false;  ///< the screen of this board sends lines without frame
    std::vector<Vector> vectors;
};

/// Reads tests/vectors/<name>.json; throws when it is wrong.
VectorFile load_vectors(std::string_view name);

}  // namespace fauxboard::testing
