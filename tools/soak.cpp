// `fauxboard soak`: years of a board's life among peers, disks and powers that misbehave.

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "emulator/host/script_files.h"
#include "emulator/world/invariants.h"
#include "emulator/world/play.h"
#include "tools/option_values.h"
#include "tools/progress.h"
#include "tools/report.h"

namespace fauxboard::tools {
namespace {

constexpr double seconds_a_year = 365.25 * 24 * 3600;

struct SoakOptions {
    std::string profile;
    std::string screen;
    std::string scenario;
    double years = 1;
    double seconds = 0;        ///< by the clock on the wall; 0: as long as it takes
    std::uint64_t worlds = 0;  ///< 0: as many as the years take
    std::uint64_t seed = 1;
    std::uint64_t steps = 60;
    std::vector<std::uint64_t> only;
    bool lines = false;
    bool json = false;
    bool promises = false;
};

std::string promises_text() {
    std::string out;
    for (const world::Invariant& each : world::invariants()) {
        out += fmt::format("{:<26} {}\n", each.name, each.promise);
    }
    return out;
}

double years(machine::SimTime time) {
    return machine::to_seconds(time) / seconds_a_year;
}

/// Writes down all that is heard and said in one life.
class Minutes final : public board::Observer {
  public:
    void on_received(board::SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override {
        const bool taken = verdict == board::Verdict::accepted;
        write(now, board::other_end(channel), taken ? ">" : "x", line);
    }
    void on_sent(board::SimTime now, board::Channel channel, std::string_view line) override {
        write(now, board::other_end(channel), "<", line);
    }
    void on_notice(board::SimTime now, board::Level, std::string_view text) override {
        write(now, "", "!", text);
    }

  private:
    static void write(board::SimTime now, std::string_view who, std::string_view way, std::string_view text) {
        print(fmt::format("{:>14.6f}  {:>7} {} {}\n", machine::to_seconds(now), who, way, text));
    }
};

world::Cast cast_of(const SoakOptions& options) {
    if (options.scenario.empty()) {
        auto screen = options.screen.empty() ? nullptr : host::load_screen_by_name(options.screen);
        return world::make_cast(host::load_profile_by_name(options.profile), std::move(screen));
    }
    const behaviour::SourceText source = host::find_script(options.scenario);
    const std::string screen = options.screen.empty() ? script::read_head(source).screen : options.screen;
    script::Cast cast;
    cast.profile = host::load_profile_by_name(options.profile);
    cast.screen = screen.empty() ? nullptr : host::load_screen_by_name(screen);
    return world::make_cast(script::load_scenario(source, host::script_finder(), cast));
}

ExitCode replay_one(const world::Cast& cast, const SoakOptions& options) {
    Minutes minutes;
    const world::Outcome outcome =
        world::play(cast, options.seed, options.only, options.lines ? &minutes : nullptr);
    print(outcome.held() ? "All promises held.\n" : world::report(cast, options.seed, options.only) + "\n");
    return outcome.held() ? ExitCode::ok : ExitCode::failed;
}

std::string text_of(const world::Soaked& soaked) {
    if (!soaked.broken.empty()) {
        return fmt::format("A promise was broken in world {}: {}\n", soaked.seeds, soaked.broken);
    }
    return fmt::format("{} worlds, {:.2f} years, {} requests: all {} promises held.\n", soaked.seeds,
                       years(soaked.time), soaked.requests, world::invariants().size());
}

std::string json_of(const world::Soaked& soaked) {
    const nlohmann::ordered_json out{
        {"worlds", soaked.seeds},
        {"years", years(soaked.time)},
        {"requests", soaked.requests},
        {"promises", world::invariants().size()},
        {"digest", fmt::format("{:016x}", soaked.digest)},
        {"broken", soaked.broken.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(soaked.broken)}};
    return out.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

ExitCode soak(const SoakOptions& options) {
    if (options.promises) {
        print(promises_text());
        return ExitCode::ok;
    }
    try {
        const world::Cast cast = cast_of(options);
        if (!options.only.empty()) {
            return replay_one(cast, options);
        }
        Progress progress;
        const auto over = [&options, begin = std::chrono::steady_clock::now()] {
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
            return options.seconds > 0 && passed.count() >= options.seconds;
        };
        const world::Soaked soaked =
            world::soak(cast, options.seed, options.steps, [&](const world::Soaked& so_far) {
                progress.say(fmt::format("{} worlds, {:.2f} of {} years, {} requests", so_far.seeds,
                                         years(so_far.time), options.years, so_far.requests));
                const bool enough = options.worlds > 0 && so_far.seeds >= options.worlds;
                return years(so_far.time) >= options.years || enough || over();
            });
        progress.clear();
        print(options.json ? json_of(soaked) : text_of(soaked));
        return soaked.broken.empty() ? ExitCode::ok : ExitCode::failed;
    } catch (const behaviour::ProfileError& error) {
        return complain("soak", ExitCode::bad_input, error.what());
    }
}

}  // namespace

void add_soak(CLI::App& app, ExitCode& exit) {
    CLI::App* command = app.add_subcommand(
        "soak",
        "Let a board live for years among peers, disks and powers that misbehave, and see that it keeps "
        "its promises");
    const auto options = std::make_shared<SoakOptions>();
    CLI::Option* profile =
        command->add_option("PROFILE", options->profile, "A name of `fauxboard profiles`, or a file")
            ->type_name("NAME|FILE");
    command
        ->add_option("--screen", options->screen,
                     "Who touches it: a screen of `fauxboard profiles`, or a file")
        ->type_name("NAME|FILE");
    command
        ->add_option("--scenario", options->scenario,
                     "Played over and over beside all that happens; its own waits may end in vain")
        ->type_name("NAME|FILE");
    command->add_option("--years", options->years, "Of virtual time, at least")
        ->type_name("N")
        ->check(number_between(0, 1'000'000))
        ->capture_default_str();
    command
        ->add_option("--seconds", options->seconds,
                     "Of real time, at most; the last world is played to its end")
        ->type_name("N")
        ->check(number_between(0, 1'000'000));
    command->add_option("--worlds", options->worlds, "How many lives, at most")
        ->type_name("N")
        ->check(whole_between(1, 1'000'000'000));
    add_seed(*command, options->seed, "Of the first world; the next has the next");
    command->add_option("--steps", options->steps, "Things that happen in one world")
        ->type_name("N")
        ->check(whole_between(1, 1'000'000))
        ->capture_default_str();
    command
        ->add_option("--only", options->only,
                     "Play these steps of the one seed alone, as a report names them")
        ->type_name("N[,N...]")
        ->delimiter(',');
    command->add_flag("--lines", options->lines, "With --only: all that is heard and said")
        ->needs(command->get_option("--only"));
    command->add_flag("--json", options->json, "The result as a JSON object");
    CLI::Option* promises =
        command->add_flag("--promises", options->promises, "List what is promised, and end");
    command->callback([options, profile, promises, &exit] {
        if (profile->count() == 0 && promises->count() == 0) {
            throw CLI::RequiredError("PROFILE");
        }
        exit = soak(*options);
    });
}

}  // namespace fauxboard::tools
