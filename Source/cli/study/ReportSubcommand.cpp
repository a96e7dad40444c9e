#include "cli/Command.h"
#include "cli/Counted.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/study/StudyReport.h"
#include "io/AtomicFile.h"
#include "io/InputFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <utility>

namespace pacini::cli
{

namespace
{
/// `study report`: the statistics.
struct ReportSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command =
            app.add_subcommand("report", "Write the report of a study: tables, tests and pictures (HTML and Markdown)");
        addOption(*command, "study", named, "Folder or file of the study, or a table of ratings (CSV)", "STUDY")
            ->required();
        addOption(*command, "-o,--output", output, "Folder for the report [report, beside the study]", "DIR");
        addOption(*command, "--combine", combined,
                  "Also compare these groups, combined to one, with the others; repeat for several combinations", "A+B")
            ->allow_extra_args(false);
        addOption(*command, "--categories", categories,
                  "Table of word categories (lines of category,word; word* matches all words with this beginning); "
                  "repeat for a second coder's, whose agreement with the first is reported",
                  "CSV")
            ->allow_extra_args(false);
        addOption(*command, "--columns", columns,
                  "Name a column of a table of ratings: its role (group, participant, block, stimulus or rating), =, "
                  "and its name; repeat for several",
                  "ROLE=NAME")
            ->allow_extra_args(false);
        addOption(
            *command, "--only", only,
            "Report only the stimuli of a class: a sign of Schaeffer's typology (such as X''), a mass, a facture or "
            "a tag",
            "CLASS");
        command->add_flag(
            "--unpaired", unpaired,
            "Compare groups by a mean for each stimulus as independent samples, also where both rated the "
            "same stimuli (as Weber 2020 does)");
        addOption(*command, "--reference", references,
                  "Stimulus of a table that is the hidden reference of a MUSHRA test, by which listeners are screened; "
                  "repeat for several [of webMUSHRA: reference]",
                  "STIMULUS")
            ->allow_extra_args(false);
        command->add_flag("--keep-everybody", keepsEverybody,
                          "Also count listeners who rated the hidden reference of a MUSHRA test below 90 in more than "
                          "15 % of the trials");
        command->add_flag("--mixed", mixed, "Also fit mixed models of the ratings, with Python's statsmodels");
        overwriting.declare(*command);
        return command->footer(
            "Means, SDs and intervals, whose sample is people; box plots; t-tests (pooled, Welch, paired), "
            "Mann-Whitney,\n"
            "Wilcoxon, effect sizes, Holm and Bonferroni; ICC, Kendall's W, Friedman; thresholds; choices; words; maps "
            "of\nsimilarity; mixed models.\n"
            "A table of ratings (.csv, .tsv or .txt) has the columns stimulus and rating, and optionally group, "
            "participant and\nblock; those of webMUSHRA and jsPsych are read as they are.\n\nExamples:\n  pacini study "
            "report coherence\n"
            "  pacini study report ratings.csv --combine A+B");
    }

    Exit run(Console& console) override
    {
        StudyReportParams params;
        params.mixed = mixed;
        params.pairStimuli = !unpaired;
        for (const std::string& text : combined)
        {
            study::GroupUnion members;
            for (std::size_t start = 0; start <= text.size();)
            {
                const std::size_t end = std::min(text.find('+', start), text.size());
                members.push_back(text.substr(start, end - start));
                start = end + 1;
            }
            if (members.size() < 2)
                return console.fail("",
                                    {ErrorCode::invalidArgument, "--combine",
                                     fmt::format("'{}' does not name two groups, such as A+B", text)},
                                    Exit::usage);
            params.unions.push_back(std::move(members));
        }
        study::RatingColumns names;
        if (const auto wrong = takeColumns(names))
            return console.fail("", *wrong, Exit::usage);
        if (categories.size() > 2)
            return console.fail("",
                                {ErrorCode::invalidArgument, "--categories",
                                 fmt::format("is given {} times; two coders are compared", categories.size())},
                                Exit::usage);
        for (const std::string& file : categories)
        {
            const auto text = readWholeFile(file, 10'000'000);
            auto table = text ? study::WordCategories::ofCsv(*text) : Result<study::WordCategories>(text.error());
            if (!table)
                return console.fail(file, table.error());
            (params.categories ? params.otherCategories : params.categories) = std::move(*table);
        }
        const fs::path path(named);
        const bool isTable = path.extension() == ".csv" || path.extension() == ".tsv" || path.extension() == ".txt";
        if (isTable && !only.empty())
            return console.fail("",
                                {ErrorCode::invalidArgument, "--only",
                                 "needs the folder of a study, whose stimuli have classes; a table has none"},
                                Exit::usage);
        auto report = isTable ? ofTable(console, path, names, params) : ofStudy(console, path, params);
        if (!report)
            return console.fail(named, report.error());
        console.warnings(named, report->warnings);
        const fs::path beside =
            isTable ? fs::path(path).replace_extension(".report") : study::studyFileOf(path).parent_path() / "report";
        return write(console, *report, output.empty() ? beside : fs::path(output));
    }

    /// A combination that names a group which is not there, or one twice, would be a group alone under another name.
    [[nodiscard]] static std::optional<Error> wrongUnion(const std::vector<study::GroupUnion>& unions,
                                                         const std::set<std::string>& groups)
    {
        for (const study::GroupUnion& members : unions)
        {
            std::set<std::string> named;
            for (const std::string& name : members)
                if (!groups.contains(name))
                    return Error{ErrorCode::invalidArgument, "--combine",
                                 fmt::format("'{}' is no group; there are {}", name, fmt::join(groups, ", "))};
                else if (!named.insert(name).second)
                    return Error{ErrorCode::invalidArgument, "--combine", fmt::format("names '{}' twice", name)};
        }
        return std::nullopt;
    }

    /// What --columns says; an error if that is no role and a name.
    [[nodiscard]] std::optional<Error> takeColumns(study::RatingColumns& names) const
    {
        const std::map<std::string_view, std::string*> roles{{"group", &names.group},
                                                             {"participant", &names.participant},
                                                             {"block", &names.block},
                                                             {"stimulus", &names.stimulus},
                                                             {"rating", &names.rating}};
        for (const std::string& text : columns)
        {
            const auto role = roles.find(std::string_view(text).substr(0, text.find('=')));
            if (role == roles.end() || text.find('=') + 1 >= text.size() || text.find('=') == std::string::npos)
                return Error{ErrorCode::invalidArgument, "--columns",
                             fmt::format("'{}' does not name a column, such as rating=score; there are group, "
                                         "participant, block, stimulus and rating",
                                         text)};
            *role->second = text.substr(text.find('=') + 1);
        }
        return std::nullopt;
    }

    [[nodiscard]] Result<StudyReport> ofTable(Console& console, const fs::path& path, const study::RatingColumns& names,
                                              const StudyReportParams& params) const
    {
        RatedTable table;
        bool isWebMushra = false;
        auto ratings = study::readRatings(path, names, &table.warnings, &isWebMushra);
        if (!ratings)
            return ratings.error();
        console.warnings(path.string(), table.warnings);
        table.ratings = std::move(*ratings);
        std::set<std::string> groups;
        for (const study::Rating& one : table.ratings)
            groups.insert(one.group);
        if (const auto wrong = wrongUnion(params.unions, groups))
            return *wrong;
        std::vector<std::string> hidden = references;
        constexpr const char* usual = "reference"; // as webMUSHRA calls it
        if (hidden.empty() && isWebMushra &&
            std::any_of(table.ratings.begin(), table.ratings.end(),
                        [](const study::Rating& one) { return one.stimulus == usual; }))
            hidden.emplace_back(usual);
        auto screening = study::screenListeners(table.ratings, hidden, keepsEverybody);
        if (!screening)
            return screening.error();
        table.screening = std::move(*screening);
        warnOf(console, path, table.screening);
        return reportOfRatings(table, path.stem().string(), params);
    }

    /// That somebody is left out must not be found in the report alone.
    static void warnOf(Console& console, const fs::path& path, const std::optional<study::Screening>& screening)
    {
        if (!screening || screening->failed.empty() || (screening->kept && !screening->nobodyPassed))
            return;
        console.warning(path.string(),
                        fmt::format("{} of {} rated the hidden reference below 90 in more than 15 % of the trials{}",
                                    screening->failed.size(),
                                    counted(screening->everyone.size(), "listener", "listeners"),
                                    screening->nobodyPassed ? "; as nobody would remain, all count"
                                                            : ": left out; --keep-everybody counts all"));
    }

    [[nodiscard]] Result<StudyReport> ofStudy(Console& console, const fs::path& path,
                                              const StudyReportParams& params) const
    {
        auto results = study::readResults(path);
        if (!results)
            return results.error();
        console.warnings(path.string(), results->warnings);
        if (!references.empty())
            return Error{ErrorCode::invalidArgument, "--reference",
                         "is for tables of ratings; the blocks of a study name theirs in study.json"};
        std::set<std::string> groups;
        for (const study::Group& one : results->study.groups)
            groups.insert(one.name);
        if (const auto wrong = wrongUnion(params.unions, groups))
            return *wrong;
        results->screening = study::screenListeners(results->ratings, results->study, keepsEverybody);
        warnOf(console, path, results->screening);
        if (!only.empty() && !study::keepClass(*results, only))
        {
            std::set<std::string> known;
            for (const study::Stimulus& one : results->study.stimuli)
                for (const auto& [order, name] : study::classesOf(one))
                    known.insert(name);
            return Error{ErrorCode::invalidArgument, "--only",
                         known.empty() ? fmt::format("'{}' is no class, as no stimulus has an object or tags", only)
                                       : fmt::format("'{}' is no class of the stimuli; there are {}", only,
                                                     fmt::join(known, ", "))};
        }
        if (!only.empty())
            results->warnings.push_back(fmt::format("only stimuli of the class {} are reported", only));
        return reportOfStudy(*results, params);
    }

    Exit write(Console& console, StudyReport& report, const fs::path& folder) const
    {
        std::error_code failed;
        fs::create_directories(folder, failed);
        if (failed)
            return console.fail(folder.string(), fileError(failed.value()));
        std::vector<std::pair<fs::path, std::string>> files{{folder / "report.html", htmlOf(report.page)},
                                                            {folder / "report.md", markdownOf(report.page)}};
        for (const PagePart& part : report.page.parts)
            if (const auto* picture = std::get_if<PagePicture>(&part))
                files.emplace_back(folder / picture->file, picture->svg);
        // All of it or nothing: a report half of which is older would be worse than none.
        for (const auto& [file, text] : files)
        {
            if (!isOccupied(file) || overwriting.replacesAll())
                continue;
            const auto there = readWholeFile(file, 100'000'000);
            if (overwriting.keepsAll() || !there || !isAsWritten(*there))
                return console.fail("", notReplaced(file, overwriting.keepsAll()
                                                              ? "exists"
                                                              : "exists and is not an unchanged report of pacini"));
        }
        for (const auto& [file, text] : files)
        {
            if (const auto written = writeFileAtomically(file, stamped(text)); !written)
                return console.fail(file.string(), written.error());
            console.wrote(file);
        }
        console.addToReport(report.json);
        return Exit::ok;
    }

    std::string named, output, only;
    std::vector<std::string> combined, columns, categories, references;
    bool mixed = false, unpaired = false, keepsEverybody = false;
    OverwriteOptions overwriting;
};
} // namespace

std::unique_ptr<Command> reportStudySubcommand()
{
    return std::make_unique<ReportSubcommand>();
}

} // namespace pacini::cli
