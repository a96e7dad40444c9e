#include "cli/Command.h"
#include "cli/Counted.h"
#include "cli/Options.h"
#include "cli/study/OpenStudy.h"
#include "io/AtomicFile.h"
#include "study/Observers.h"
#include "study/StudyFile.h"
#include "study/StudyResults.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

namespace pacini::cli
{

namespace
{
/// `study simulate`: simulated participants.
struct SimulateStudySubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command =
            addStudyCommand(app, "simulate", "Run a study with simulated participants and compute its power", named);
        addOption(*command, "-o,--output", output,
                  "New folder for the study with all simulated sessions, for 'study report'", "DIR");
        addPreset(*command, "--effect", observers.effect,
                  "Difference of the last group from the others, points on a scale of ten", numberFrom(-10.0, 10.0),
                  "POINTS");
        addPreset(*command, "--noise", observers.noiseSd, "SD of one rating, points", numberFrom(0.0, 10.0), "POINTS");
        addPreset(*command, "--bias", observers.biasSd, "SD between participants, points", numberFrom(0.0, 10.0),
                  "POINTS");
        addPreset(*command, "--threshold", observers.threshold,
                  "Mean threshold at the best frequency, dB re full drive", numberFrom(-200.0, 0.0), "DB");
        addPreset(*command, "--runs", runs, "Number of simulated studies for the power",
                  wholeNumberFrom(std::size_t(1), std::size_t(1'000'000)), "N");
        addPreset(*command, "--seed", observers.seed, "Seed of the simulated participants", countingNumber(), "N");
        return command->footer(
            "Raters have a bias and noise; thresholds follow a Weibull function. The SDs are about those "
            "of Weber\n(2020). Power is the share of such studies that find the effect at p <= .05, with a "
            "mean for each\nparticipant (pooled t-test, two-sided).\n\nExample:\n  pacini study simulate "
            "coherence --effect 1 -o "
            "simulated");
    }

    Exit run(Console& console) override
    {
        auto opened = openStudy(console, named);
        if (!opened)
            return Exit::failed;
        JsonReport::Json power = JsonReport::Json::array();
        for (const study::PowerEstimate& one : study::estimatePower(opened->study, observers, runs))
        {
            console.print(
                fmt::format("{} against {}: an effect of {} is found in {:.1f} % of {} ({:.1f} % by the non-central t "
                            "distribution, for scales without ends)",
                            one.first, one.second, observers.effect, 100.0 * one.byParticipant,
                            counted(one.runs, "study", "studies"), 100.0 * one.analytic));
            power.push_back({{"first", one.first},
                             {"second", one.second},
                             {"power", one.byParticipant},
                             {"standardError", one.standardError},
                             {"analytic", one.analytic},
                             {"runs", one.runs}});
        }
        if (power.empty() && output.empty())
            console.print("The study has no ratings of two groups to compare; -o writes the simulated sessions");
        console.addToReport({{"power", std::move(power)}});
        return output.empty() ? Exit::ok : writeSessions(console, *opened);
    }

    Exit writeSessions(Console& console, const OpenedStudy& opened)
    {
        const fs::path folder(output);
        std::error_code failed;
        if (fs::exists(folder, failed) && !fs::is_empty(folder, failed))
            return console.fail(
                output, {ErrorCode::io, "",
                         "exists and is not empty; name a new folder, to keep simulated and real answers apart"});
        fs::create_directories(folder, failed);
        if (failed)
            return console.fail(output, fileError(failed.value()));
        study::Study moved = study::relocated(opened.study, opened.folder, folder);
        moved.description = "SIMULATED. " + moved.description;
        if (const auto written = writeFileAtomically(folder / study::studyFileName, study::studyJson(moved)); !written)
            return console.fail(output, written.error());
        const int count = study::participantsOf(moved);
        for (int i = 0; i < count; ++i)
        {
            console.progress(static_cast<double>(i) / count, "simulating participants");
            study::SessionStart start;
            start.program = "Pacini, simulated";
            auto session = study::Session::begin(moved, folder, start);
            if (!session)
                return console.fail(output, session.error());
            if (const auto done = study::simulateSession(moved, **session, observers); !done)
                return console.fail((*session)->path().string(), done.error());
        }
        console.endProgress();
        console.addToReport({{"sessions", count}, {"output", output}});
        console.note(fmt::format("{}: {}", printable(output),
                                 counted(static_cast<std::size_t>(count), "simulated session", "simulated sessions")));
        return Exit::ok;
    }

    std::string named, output;
    study::ObserverParams observers;
    std::size_t runs = 2000;
};
} // namespace

std::unique_ptr<Command> simulateStudySubcommand()
{
    return std::make_unique<SimulateStudySubcommand>();
}

} // namespace pacini::cli
