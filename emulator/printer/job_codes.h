#pragma once

namespace fauxboard::printer {

class JobRunner;
struct GcodeLine;

/// What a code in a job's file does.
struct JobCode {
    char letter;
    int code;
    bool at_rest;  ///< only when all moves before it are done (the firmware's st_synchronize())
    void (*run)(JobRunner&, const GcodeLine&);
};

/// The row of a code; nullptr when it is unknown.
const JobCode* find_job_code(char letter, int code);

}  // namespace fauxboard::printer
