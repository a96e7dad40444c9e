#pragma once

// Parts of a study's report: headings, sentences, tables and pictures, and how numbers are written in them.

#include "cli/Console.h"
#include "cli/study/StudyFigures.h"
#include "cli/study/StudyReport.h"
#include "study/statistics/Sample.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace pacini::cli
{

inline const plot::FigureStyle pictureStyle{{1200, 600}, false};

/// Group and participant.
using Person = std::pair<std::string, std::string>;

/// p as papers print it: three decimals, or that it is below the smallest of them.
[[nodiscard]] inline std::string pText(double p)
{
    return p < 0.0005 ? "< .001" : decimalText(p, 3);
}

/// The same within a sentence.
[[nodiscard]] inline std::string pSaid(double p)
{
    return p < 0.0005 ? "p < .001" : "p = " + pText(p);
}

[[nodiscard]] inline std::string intervalText(const study::Interval& interval, int decimals)
{
    return fmt::format("{} to {}", decimalText(interval.low, decimals), decimalText(interval.high, decimals));
}

/// Standard deviation, and interval of the mean: of two values and more. One has none, which is no deviation of 0.
[[nodiscard]] inline std::string sdText(const study::SampleSummary& sample, int decimals)
{
    return sample.count < 2 ? "" : decimalText(sample.sd, decimals);
}
[[nodiscard]] inline std::string meanIntervalText(const study::SampleSummary& sample, int decimals)
{
    return sample.count < 2 ? "" : intervalText(sample.mean95, decimals);
}

[[nodiscard]] inline std::string groupTitle(const std::string& name)
{
    return name.empty() ? std::string("all") : name;
}

/// Letters and digits of a title, for the name of a file.
[[nodiscard]] inline std::string fileNameOf(std::string_view text)
{
    std::string name;
    for (const char c : text)
        name += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ? c : '-';
    return name;
}

[[nodiscard]] inline nlohmann::ordered_json summaryJson(const study::SampleSummary& sample)
{
    nlohmann::ordered_json sd, mean95; // null: one value has none
    if (sample.count > 1)
    {
        sd = sample.sd;
        mean95 = {sample.mean95.low, sample.mean95.high};
    }
    return {{"n", sample.count},
            {"mean", sample.mean},
            {"sd", sd},
            {"mean95", mean95},
            {"median", sample.median},
            {"quartiles", {sample.lowerQuartile, sample.upperQuartile}},
            {"range", {sample.lowest, sample.highest}}};
}

/// Builds the page part by part.
class ReportWriter
{
public:
    explicit ReportWriter(StudyReport& toFill) : report(toFill) {}

    void heading(int level, std::string text) { report.page.parts.emplace_back(PageHeading{level, std::move(text)}); }
    void warning(std::string text) { report.warnings.push_back(std::move(text)); }
    /// A sentence of the methods: how something in the report was computed. Said once.
    void method(std::string text)
    {
        if (std::find(report.methods.begin(), report.methods.end(), text) == report.methods.end())
            report.methods.push_back(std::move(text));
    }
    void paragraph(std::string text) { report.page.parts.emplace_back(PageParagraph{std::move(text)}); }
    void table(PageTable made)
    {
        if (!made.rows.empty())
            report.page.parts.emplace_back(std::move(made));
    }
    [[nodiscard]] Result<void> picture(std::string file, std::string description, const plot::Figure& figure)
    {
        auto svg = svgOf(figure, pictureStyle);
        if (!svg)
            return svg.error();
        report.page.parts.emplace_back(PagePicture{std::move(file), std::move(description), std::move(*svg)});
        return {};
    }

private:
    StudyReport& report;
};

} // namespace pacini::cli
