#include "cli/bench/Bench.h"
#include "cli/bench/Timed.h"
#include "cli/bench/ZeroPhaseBank.h"

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/filters/RationalDecimator.h>
#include <pacini/simplify/BudgetSpread.h>
#include <pacini/simplify/CurveError.h>
#include <pacini/simplify/Simplify.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

namespace pacini::cli
{

namespace
{
using Curves = std::vector<Curve>;

constexpr double simplifyExcerpt = 4.0; // s of each sound: the exact method takes minutes for more

/// Criterion by which a simplification chooses its points.
enum class GoalKind
{
    count, ///< so many points per second and curve
    bound, ///< a largest error, as a share of the curve's peak
    price, ///< of a point, in samples times squared errors as shares of the peak
};

struct Goal
{
    GoalKind kind;
    double value;
};

std::string kindText(GoalKind kind)
{
    return kind == GoalKind::count ? "count" : kind == GoalKind::bound ? "tolerance" : "price";
}

std::string valueText(const Goal& goal)
{
    return goal.kind == GoalKind::count   ? fmt::format("{:g}/s", goal.value)
           : goal.kind == GoalKind::bound ? fmt::format("{:g} %", 100.0 * goal.value)
                                          : fmt::format("{:g}", goal.value);
}

/// A way to simplify all curves of a sound; nothing where it has no such goal.
struct Simplifier
{
    std::string name;
    std::function<std::optional<Curves>(const Curves&, const Goal&)> run;
};

/// Envelopes of six bands at 1 kHz as the thesis has them, each with a peak of 1; bands 40 dB below the loudest are
/// left out.
Curves denseEnvelopes(const BenchSound& sound)
{
    RationalDecimator decimator(sound.sampleRate, analysisRate);
    std::vector<float> low;
    decimator.push(sound.beginning(simplifyExcerpt), low);
    decimator.finish(low);
    ZeroPhaseBankParams bank;
    bank.layout.kind = BandLayoutKind::tiled;
    Curves curves;
    std::vector<double> peaks;
    for (const auto& band : splitZeroPhase(low, analysisRate, bank))
    {
        EnvelopeTrack track({}, analysisRate);
        track.push(band);
        Curve& curve = track.curve();
        double peak = 0.0;
        for (const Breakpoint& point : curve)
            peak = std::max(peak, point.value);
        for (Breakpoint& point : curve)
            point.value /= peak > 0.0 ? peak : 1.0;
        peaks.push_back(peak);
        curves.push_back(std::move(curve));
    }
    const double loudest = *std::max_element(peaks.begin(), peaks.end());
    Curves loud;
    for (std::size_t k = 0; k < curves.size(); ++k)
        if (curves[k].size() > 2 && peaks[k] > 0.01 * loudest)
            loud.push_back(std::move(curves[k]));
    return loud;
}

double seconds(const Curve& curve)
{
    return curve.back().time - curve.front().time;
}

std::size_t pointsFor(const Curve& curve, double perSecond)
{
    return std::max<std::size_t>(2, static_cast<std::size_t>(std::lround(perSecond * seconds(curve))));
}

RefitParams above0()
{
    RefitParams params;
    params.lowest = 0.0;
    return params;
}

/// One method of the library, curve by curve.
Simplifier libraryMethod(const std::string& name, SimplifyMethod method, bool withRefit)
{
    return {withRefit ? name + "+refit" : name,
            [=](const Curves& dense, const Goal& goal) -> std::optional<Curves>
            {
                if (goal.kind == GoalKind::price)
                    return std::nullopt;
                Curves curves;
                for (const Curve& curve : dense)
                {
                    SimplifyParams params;
                    params.method = method;
                    params.refit = withRefit;
                    params.lowest = 0.0;
                    if (goal.kind == GoalKind::count)
                        params.count = pointsFor(curve, goal.value);
                    else
                        params.maxError = goal.value;
                    curves.push_back(simplify(curve, params).value());
                }
                return curves;
            }};
}

/// Points at equal distances: what everything else must beat.
Simplifier evenSpacing(bool withRefit)
{
    return {withRefit ? "even spacing+refit" : "even spacing",
            [=](const Curves& dense, const Goal& goal) -> std::optional<Curves>
            {
                if (goal.kind != GoalKind::count)
                    return std::nullopt;
                Curves curves;
                for (const Curve& curve : dense)
                {
                    const std::size_t count = std::min(pointsFor(curve, goal.value), curve.size());
                    KeptPoints kept;
                    for (std::size_t k = 0; k < count; ++k)
                        kept.push_back(k * (curve.size() - 1) / (count - 1));
                    curves.push_back(withRefit ? refit(curve, curveOf(curve, kept), {}, above0())
                                               : curveOf(curve, kept));
                }
                return curves;
            }};
}

/// All curves of the sound out of one budget.
Simplifier sharedBudget()
{
    return {"shared budget+refit",
            [](const Curves& dense, const Goal& goal) -> std::optional<Curves>
            {
                if (goal.kind != GoalKind::count)
                    return std::nullopt;
                std::vector<DenseColumns> columns;
                std::vector<BudgetCurve> shares;
                std::size_t budget = 0;
                for (const Curve& curve : dense)
                {
                    columns.emplace_back(curve);
                    budget += std::min(pointsFor(curve, goal.value), curve.size());
                }
                for (const DenseColumns& column : columns)
                    shares.push_back({column.samples(), 1.0, 2});
                const auto found = BudgetSpread(1024).spread(shares, budget);
                Curves curves;
                for (std::size_t c = 0; c < dense.size(); ++c)
                    curves.push_back(refit(dense[c], curveOf(dense[c], found->kept[c]), {}, above0()));
                return curves;
            }};
}

/// A fixed price per point, as the encoder does it.
Simplifier fixedPrice()
{
    return {"lagrangian+refit",
            [](const Curves& dense, const Goal& goal) -> std::optional<Curves>
            {
                if (goal.kind != GoalKind::price)
                    return std::nullopt;
                LagrangianSegmenter segmenter(1024);
                KeptPoints kept;
                Curves curves;
                for (const Curve& curve : dense)
                {
                    const DenseColumns columns(curve);
                    segmenter.solve(columns.samples(), goal.value, kept);
                    curves.push_back(refit(curve, curveOf(curve, kept), {}, above0()));
                }
                return curves;
            }};
}

std::vector<Simplifier> simplifiers()
{
    std::vector<Simplifier> all;
    for (const bool withRefit : {false, true})
    {
        all.push_back(libraryMethod("lagrangian", SimplifyMethod::lagrangian, withRefit));
        all.push_back(libraryMethod("visvalingam", SimplifyMethod::visvalingam, withRefit));
        all.push_back(libraryMethod("douglas-peucker", SimplifyMethod::douglasPeucker, withRefit));
        all.push_back(libraryMethod("streaming", SimplifyMethod::streaming, withRefit));
        all.push_back(evenSpacing(withRefit));
    }
    all.push_back(libraryMethod("optimal", SimplifyMethod::optimal, false)); // a refit would give up what it is for
    all.push_back(sharedBudget());
    all.push_back(fixedPrice());
    return all;
}

void measureSimplify(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    const Curves dense = denseEnvelopes(sound);
    if (dense.empty())
        return;
    double points = 0.0, duration = 0.0;
    for (const Curve& curve : dense)
    {
        points += static_cast<double>(curve.size());
        duration += seconds(curve);
    }
    std::vector<Goal> goals;
    for (const double rate : {5.0, 10.0, 20.0, 40.0})
        goals.push_back({GoalKind::count, rate});
    for (const double bound : {0.10, 0.05, 0.02, 0.01})
        goals.push_back({GoalKind::bound, bound});
    for (const double price : {3.0, 0.3, 0.03, 0.003})
        goals.push_back({GoalKind::price, price});
    for (const Goal& goal : goals)
        for (const Simplifier& simplifier : simplifiers())
        {
            const auto run = timed(settings.repeats, [&] { return simplifier.run(dense, goal); });
            if (!run.result)
                continue;
            double kept = 0.0, squares = 0.0, largest = 0.0;
            for (std::size_t c = 0; c < dense.size(); ++c)
            {
                const CurveError error = curveError(dense[c], (*run.result)[c]);
                kept += static_cast<double>((*run.result)[c].size());
                squares += error.rms * error.rms * static_cast<double>(dense[c].size());
                largest = std::max(largest, error.max);
            }
            rows.add({sound.name, kindText(goal.kind), valueText(goal), simplifier.name, kept, points, duration,
                      run.seconds, 100.0 * std::sqrt(squares / points), 100.0 * largest});
        }
}
} // namespace

Bench simplifyBench()
{
    const auto figure = [](std::string name, std::string by)
    {
        return BenchFigure{name, "Simplifiers by " + by, "method", "time", "rmsError", "goal", "by", by};
    };
    return {
        "simplify",
        "Simplifiers",
        "Curves: envelopes at 1 kHz of six bands of the first 4 s of each sound, bands 40 dB below the loudest left "
        "out. Errors are shares of the curve's peak, RMS over all points of all bands, mean over the sounds; time is "
        "per point of the dense curve. The optimal method has the least maximum error there is, the lagrangian one "
        "nearly the least RMS error; the shared budget moves points between the bands; a price is what the encoder "
        "uses.",
        columnsOf({"by", "goal", "method"}, {summed("points"),
                                             summed("densePoints"),
                                             summed("duration", "s"),
                                             summed("seconds", "s"),
                                             {"rmsError", "%"},
                                             {"maxError", "%"},
                                             {"pointsPerSecond", "1/s", Reduction::ratio, "points", "duration"},
                                             {"time", "ns/point", Reduction::ratio, "seconds", "densePoints", 1e9},
                                             {"timesRealTime", "", Reduction::ratio, "duration", "seconds"},
                                             {"relativeTime", "", Reduction::relative, "time", "goal"}}),
        {figure("count", "count"), figure("tolerance", "tolerance")},
        {},
        measureSimplify};
}

} // namespace pacini::cli
