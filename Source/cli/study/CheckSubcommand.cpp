#include "cli/Command.h"
#include "cli/Counted.h"
#include "cli/Options.h"
#include "cli/ProfileInput.h"
#include "cli/study/OpenStudy.h"
#include "study/Observers.h"
#include "study/StudyCheck.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

namespace pacini::cli
{

namespace
{
/// `study check`: finds problems of a study.
struct CheckSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command = addStudyCommand(app, "check", "Check a study for problems before inviting participants", named);
        addOption(*command, "--profile", profile, "Actuator profile: a file or a shipped profile [that of the study]",
                  "PROFILE");
        addOption(*command, "--effect", effect,
                  "Effect whose power is told, points on a scale of ten [a table from d = .2 to 1.2]",
                  numberFrom(-10.0, 10.0), "POINTS");
        return command->footer(
            "Finds missing files and texts, uneven groups, sessions that are too long, exposure beyond the limit\n(ISO "
            "5349-1, on seats 2631-1), stimuli that can hardly be distinguished, and the levels of sounds: dB re "
            "full\nscale, "
            "LUFS, and with a calibration (see study tone) dB SPL and dB(A). Exits with 1 if the study cannot\nbe "
            "run. For ratings it also tells the power of the design by its people and trials, at 5 % and without\na "
            "correction; 'study simulate' has the SDs that points are of.");
    }

    /// Prints the levels of the sounds.
    static JsonReport::Json soundsOf(Console& console, const study::StudyCheck& check)
    {
        JsonReport::Json sounds = JsonReport::Json::array();
        for (const study::HeardStimulus& one : check.heard)
        {
            JsonReport::Json entry{
                {"stimulus", one.stimulus}, {"rms", one.levels.rms}, {"weighted", one.levels.weighted}};
            std::string line = fmt::format("\"{}\": {:.1f} dB re full scale (RMS)", one.stimulus, one.levels.rms);
            if (one.levels.loudness)
            {
                line += fmt::format(", {:.1f} LUFS", *one.levels.loudness);
                entry["loudness"] = *one.levels.loudness;
            }
            if (one.soundPressure && one.weighted)
            {
                line += fmt::format(", {:.1f} dB SPL, {:.1f} dB(A)", *one.soundPressure, *one.weighted);
                entry["soundPressure"] = *one.soundPressure;
                entry["soundPressureWeighted"] = *one.weighted;
            }
            console.print(line);
            sounds.push_back(std::move(entry));
        }
        return sounds;
    }

    /// Prints how often the comparisons of the study find an effect.
    [[nodiscard]] JsonReport::Json powerOf(Console& console, const study::Study& planned) const
    {
        JsonReport::Json power = JsonReport::Json::array();
        for (const study::DesignPower& one : study::powerOfDesign(planned, {}, effect))
        {
            const bool isPair = !one.block.empty();
            std::string line = isPair
                                   ? fmt::format("Power of two stimuli of \"{}\" ({}, {} of each):", one.block,
                                                 counted(static_cast<std::size_t>(one.firstPeople), "person", "people"),
                                                 counted(one.trials, "rating", "ratings"))
                                   : fmt::format("Power of {} against {} ({} and {} people, {}):", one.first,
                                                 one.second, one.firstPeople, one.secondPeople,
                                                 counted(one.trials, "rating each", "ratings each"));
            JsonReport::Json effects = JsonReport::Json::array();
            for (const study::EffectPower& found : one.effects)
            {
                line += fmt::format("{} d {:.2g} ({:.1f} points) {:.0f} %", effects.empty() ? "" : ",", found.effect,
                                    found.points, 100.0 * found.power);
                effects.push_back({{"d", found.effect}, {"points", found.points}, {"power", found.power}});
            }
            console.print(line);
            JsonReport::Json entry = isPair ? JsonReport::Json{{"block", one.block}, {"people", one.firstPeople}}
                                            : JsonReport::Json{{"first", one.first},
                                                               {"second", one.second},
                                                               {"people", {one.firstPeople, one.secondPeople}}};
            entry["trials"] = one.trials;
            entry["effects"] = std::move(effects);
            power.push_back(std::move(entry));
        }
        return power;
    }

    Exit run(Console& console) override
    {
        auto opened = openStudy(console, named);
        if (!opened)
            return Exit::failed;
        study::StimulusParams params;
        params.folder = opened->folder;
        const std::string actuator = actuatorOf(opened->study, opened->folder, profile);
        if (!actuator.empty())
        {
            params.profile = openProfile(console, actuator);
            if (!params.profile)
                return Exit::failed;
        }
        const auto check = study::checkStudy(opened->study, params,
                                             [&](double share) { console.progress(share, "making the stimuli"); });
        console.endProgress();
        const std::string file = opened->file.string();
        JsonReport::Json findings = JsonReport::Json::array(), groups = JsonReport::Json::array();
        bool spoils = false;
        for (const study::Finding& one : check.findings)
        {
            spoils = spoils || one.spoils;
            findings.push_back({{"spoils", one.spoils}, {"where", one.where}, {"message", one.message}});
            if (one.spoils)
                console.error(file, {ErrorCode::invalidData, one.where, one.message});
            else
                console.warning(file, one.where + ": " + one.message);
        }
        for (const study::GroupLoad& load : check.loads)
        {
            groups.push_back({{"group", load.group},
                              {"trials", load.trials},
                              {"minutes", load.minutes},
                              {"exposure", load.exposure}});
            if (load.soundDaily)
                groups.back()["soundDaily"] = *load.soundDaily;
            console.print(
                fmt::format("{}: {} trials, some {:.0f} minutes, A(8) = {:.2f} m/s2{} of {:.1f} allowed", load.group,
                            load.trials, load.minutes, load.exposure,
                            check.exposureIsAssumed
                                ? fmt::format(" (assuming {:.0f} m/s2 at full drive, {})", study::assumedAcceleration,
                                              params.profile && params.profile->measurement
                                                  ? "as the measured levels of the profile are relative"
                                                  : "which the profile does not state")
                                : "",
                            opened->study.limits.daily));
            if (load.soundDaily)
                console.print(fmt::format("{}: sound L_EX,8h = {:.1f} dB(A) of {:.1f} allowed", load.group,
                                          *load.soundDaily,
                                          opened->study.limits.soundDaily.value_or(study::usualSoundDaily)));
        }
        console.addToReport({{"sounds", soundsOf(console, check)}});
        console.addToReport({{"power", powerOf(console, opened->study)}});
        console.addToReport({{"findings", std::move(findings)},
                             {"groups", std::move(groups)},
                             {"exposureIsAssumed", check.exposureIsAssumed}});
        if (check.findings.empty())
            console.note("no problems found");
        return spoils ? Exit::failed : Exit::ok;
    }

    std::string named, profile;
    std::optional<double> effect;
};
} // namespace

std::unique_ptr<Command> checkStudySubcommand()
{
    return std::make_unique<CheckSubcommand>();
}

} // namespace pacini::cli
