#include "emulator/filament/slicer_comments.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace fauxboard::filament;

namespace {

/// The layers shown after each of the comments.
std::vector<int> layers(const std::vector<std::string>& comments) {
    SlicerNotes notes;
    std::vector<int> shown;
    for (const std::string& comment : comments) {
        notes.take(comment);
        shown.push_back(notes.layer());
    }
    return shown;
}

}  // namespace

TEST_CASE("slicers: Cura and ideaMaker count their layers from 0") {
    CHECK(layers({"LAYER:0", "LAYER:1", "TYPE:FILL", "LAYER: 2"}) == std::vector{1, 2, 2, 3});
    CHECK(layers({"LAYER:-2", "LAYER:-1", "LAYER:0"}) == std::vector{0, 0, 1});  // a raft
    SlicerNotes notes;
    notes.take("LAYER_COUNT:21");
    notes.take("TIME:3661.5");
    CHECK(notes.layers() == 21);
    CHECK(notes.seconds() == 3661.5);
    CHECK(notes.layer() == 0);
    CHECK(notes.layer_mm() == 0);
    for (const char* height :
         {"Layer height: ", "Layer height: -1", "Layer height: 0", "Layer height: 1000"}) {
        notes.take(height);
        CHECK(notes.layer_mm() == 0);
    }
    notes.take("Layer height: 0.15");
    notes.take("Layer height: 0.3");  // of a second part: the first one stays
    CHECK(notes.layer_mm() == 0.15);
}

TEST_CASE("slicers: Simplify3D counts from 1") {
    CHECK(layers({" layer 1, Z = 0.200", " layer 2, Z = 0.400"}) == std::vector{1, 2});
}

TEST_CASE("slicers: PrusaSlicer only says that a layer begins, and its ancestors say it otherwise") {
    CHECK(layers({"LAYER_CHANGE", "Z:0.2", "BEFORE_LAYER_CHANGE", "LAYER_CHANGE", "BEFORE_LAYER_CHANGE"}) ==
          std::vector{1, 1, 1, 2, 2});
    CHECK(layers({"BEFORE_LAYER_CHANGE", "0.2", "BEFORE_LAYER_CHANGE"}) == std::vector{1, 1, 2});
    CHECK(layers({"LAYER_CHANGE", "LAYER:0", "LAYER_CHANGE", "LAYER:1"}) == std::vector{1, 1, 1, 2});
    CHECK(read_slicer_comment(" total layers count = 98").layers == 98);
    CHECK(read_slicer_comment(" estimated printing time (normal mode) = 1d 2h 3m 4s").seconds == 93784);
    CHECK(read_slicer_comment(" estimated printing time (normal mode) = 45s").seconds == 45);
}

TEST_CASE("slicers: other comments, and numbers that are none, say nothing") {
    for (const char* text : {"", " ", "LAYER", "LAYER:", "LAYER:x", "LAYER:99999999", "LAYER_COUNT:0",
                             "LAYER_COUNT:-3", "TIME:", "TIME:x", "layer height = 0.2", "LAYERS:3",
                             " estimated printing time (normal mode) = ", "TIME_ELAPSED:12", "\xFF\xFE"}) {
        CAPTURE(std::string(text));
        const SlicerNote note = read_slicer_comment(text);
        CHECK_FALSE(note.layer.has_value());
        CHECK_FALSE(note.layers.has_value());
        CHECK_FALSE(note.seconds.has_value());
        CHECK_FALSE(note.next_layer);
    }
}

TEST_CASE("slicers: layers of how many, times in words, each as far as it is told") {
    CHECK(layers({"layer num/total_layer_count: 3/9", "layer num/total_layer_count: 4"}) ==
          std::vector{3, 4});
    CHECK(read_slicer_comment("layer num/total_layer_count: 3/9").layers == 9);
    CHECK_FALSE(read_slicer_comment("layer num/total_layer_count: 3").layers.has_value());
    CHECK(layers({"BEGIN_LAYER_OBJECT z=0.2", "BEGIN_LAYER_OBJECT z=0.4"}) == std::vector{1, 2});
    CHECK_FALSE(read_slicer_comment("total layers count = x").layers.has_value());
    CHECK(read_slicer_comment(" model printing time: 1m 30s").seconds == 90);
    CHECK(read_slicer_comment(" model printing time: 1m 30s; total estimated time: 2m 5s").seconds == 125);
    const std::string time = " estimated printing time (normal mode) = ";
    for (const char* none : {"5x", "5", "1h 5", "x", "99999999999999d"}) {
        CAPTURE(std::string(none));
        CHECK_FALSE(read_slicer_comment(time + none).seconds.has_value());
    }
    CHECK(read_slicer_comment(time + "1h x").seconds == 3600);
}

TEST_CASE("slicers: the end of a file tells what its beginning could not") {
    SlicerNotes notes;
    notes.take_tail("G1 X5 ; layer 9, here too\n; layer 7, Z = 1.4\nG1\n; layer 8, Z = 1.6\nM84");
    CHECK(notes.layers() == 9);
    SlicerNotes told;
    told.take_tail(";LAYER:4\n; total layers count = 12\n;TIME:60\r\n");
    CHECK(told.layers() == 12);
    CHECK(told.seconds() == 60);
    SlicerNotes none;
    none.take_tail("G1 X5\nM84");
    CHECK(none.layers() == 0);
}
