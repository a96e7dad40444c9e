#include "cli/plot/AnalysisFigure.h"

#include "cli/plot/ShownCurve.h"

#include <pacini/analysis/AnalysisInput.h>
#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/Encoder.h>
#include <pacini/analysis/OnsetDetector.h>
#include <pacini/analysis/OnsetFeatures.h>
#include <pacini/analysis/OnsetSalience.h>
#include <pacini/analysis/SlidingBuffer.h>
#include <pacini/analysis/SpectralCentroid.h>
#include <pacini/analysis/TransientDetector.h>
#include <pacini/analysis/methods/Method.h>
#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace pacini::plot
{

namespace
{
/// A score in units of its threshold, and the events that were found by it.
struct Score
{
    std::string name;
    std::string events;
    std::vector<Point> points;
    std::vector<double> times; ///< s
};

/// The largest value of each of `columns` parts of `range`, at its place: a picture cannot show more.
template <typename Values>
std::vector<Point> peaksWithin(const Values& values, double rate, TimeRange range, std::size_t columns)
{
    std::vector<Point> points;
    const double width = (range.to - range.from) / static_cast<double>(columns);
    const auto first = static_cast<std::size_t>(std::max(0.0, std::floor(range.from * rate)));
    std::size_t last = columns; // column of the last point; none yet
    for (std::size_t n = first; n < values.size(); ++n)
    {
        const double time = static_cast<double>(n) / rate;
        if (time > range.to)
            break;
        const auto column = static_cast<std::size_t>(std::max(0.0, (time - range.from) / width));
        const Point point{time, static_cast<double>(values[n])};
        if (points.empty() || column != last)
            points.push_back(point);
        else if (point.y > points.back().y)
            points.back() = point;
        last = column;
    }
    return points;
}

/// The magnitude of the signal of all bands, as a2vt has it, in units of the largest magnitude of `sound`.
std::vector<float> ownEnvelope(const MethodSound& sound, const EncoderParams& params)
{
    AnalysisInput input;
    input.start(static_cast<int>(sound.fs), 1);
    BandAnalysis analysis({Encoder::bandsOf(params)});
    const auto take = [&]
    {
        const std::vector<std::span<const float>> channels{input.channels().front()};
        analysis.push(channels);
    };
    sound.forEachPart(
        [&](std::span<const float> part)
        {
            input.push(part);
            take();
        });
    input.finish();
    take();
    return analysis.finish().envelope;
}

Score ownScore(std::span<const float> mono, double fs, const EncoderParams& params, TimeRange range,
               std::size_t columns)
{
    OnsetFeatures features(fs, 1);
    features.push(mono);
    features.finish();
    const auto frames = features.frames();
    SlidingBuffer<OnsetFrame> buffer{OnsetSalience::history};
    std::copy(frames.begin(), frames.end(), buffer.extend(std::ssize(frames)));
    buffer.extend(OnsetSalience::lookAhead);
    SlidingBuffer<float> salience{0};
    const OnsetParams& onsets = params.onsets;
    OnsetSalience(std::clamp(onsets.sensitivity, 0.25, 4.0)).extend(buffer, salience);
    const std::span<const float> scores(salience.at(0), static_cast<std::size_t>(salience.end()));
    Score score{"onset score of a2vt", "events", peaksWithin(scores, OnsetFrame::rate, range, columns), {}};
    OnsetDetector detector(onsets);
    detector.push(frames);
    for (const Onset& onset : detector.finish())
        score.times.push_back(onset.time);
    return score;
}

Score thesisScore(const MethodSound& sound, const TransientDetectorParams& params, TimeRange range, std::size_t columns)
{
    TransientScore follower;
    follower.setParams(params.score);
    follower.prepare({sound.fs, sound.samples.size()});
    std::vector<float> scores(sound.samples.size());
    follower.process(sound.samples, scores);
    const double threshold = std::max(params.threshold, 1e-9);
    Score score{"onset score |fast \u2212 slow|", "transients", peaksWithin(scores, sound.fs, range, columns), {}};
    for (Point& point : score.points)
        point.y /= threshold;
    for (const DetectedTransient& event : detectTransients(sound.samples, sound.fs, params))
        score.times.push_back(static_cast<double>(event.frame) / sound.fs);
    return score;
}

Panel envelopePanel(const MethodSound& sound, const MethodCurveParams& curves, const EncoderParams* own,
                    TimeRange range, const FigureStyle& style, const Look& look)
{
    const auto columns = static_cast<std::size_t>(style.size.width);
    std::vector<float> magnitude(sound.samples.size());
    std::transform(sound.samples.begin(), sound.samples.end(), magnitude.begin(), [](float x) { return std::abs(x); });
    Panel panel;
    panel.title = "Magnitude and envelope (1 = largest)";
    panel.x = timeAxis(range);
    panel.y = {"Amplitude", Scale::linear, 0.0, 1.05, {}};
    const double hair = look.metrics.hair();
    panel.series.push_back(
        Line{"magnitude", peaksWithin(magnitude, sound.fs, range, columns), Stroke{look.theme.quietText, hair}, {}});
    if (own != nullptr)
        panel.series.push_back(
            Line{"envelope of a2vt",
                 peaksWithin(ownEnvelope(sound, *own), 1.0 / BandAnalysisResult::envelopeStep, range, columns),
                 Stroke{look.theme.series(1), 1.6 * hair},
                 {}});
    const EnvelopeFollowerParams& follower = curves.follower;
    panel.series.push_back(Line{fmt::format("follower, {:g}, {:g}, {:g} ms", 1e3 * follower.attack.value,
                                            1e3 * follower.hold.value, 1e3 * follower.release.value),
                                shownBreakpoints(envelopeTrack(sound, curves), range),
                                Stroke{look.theme.series(0), 1.6 * hair},
                                {}});
    return panel;
}

Panel scorePanel(const Score& score, TimeRange range, const Look& look)
{
    Panel panel;
    panel.title = "Onset score (1 = threshold)";
    panel.x = timeAxis(range);
    double largest = 1.0;
    for (const Point& point : score.points)
        largest = std::max(largest, point.y);
    panel.y = {"Score", Scale::linear, 0.0, 1.1 * largest, {}};
    const double hair = look.metrics.hair();
    panel.series.push_back(Line{score.name, score.points, Stroke{look.theme.series(0), 1.4 * hair}, {}});
    panel.series.push_back(
        Line{"threshold", {{range.from, 1.0}, {range.to, 1.0}}, Stroke{look.theme.series(3), 1.4 * hair}, {}});
    std::vector<Point> events;
    for (const double time : score.times)
        if (time >= range.from && time <= range.to)
            events.push_back({time, 1.0});
    panel.series.push_back(
        Line{score.events, std::move(events), {}, Marker{MarkerShape::triangle, look.theme.series(3), 8.0 * hair}});
    return panel;
}

Panel centroidPanel(const MethodSound& sound, TimeRange range, const Look& look)
{
    SpectralCentroidParams params;
    params.frames = powerOfTwoFrames(sound.fs);
    const auto points = shownBreakpoints(spectralCentroid(sound.samples, sound.fs, params), range);
    std::vector<double> values;
    for (const Point& point : points)
        values.push_back(point.y);
    Panel panel;
    panel.title = "Spectral centroid";
    panel.x = timeAxis(range);
    panel.y = axisAround("Hz", Scale::logarithmic, values);
    panel.series.push_back(Line{"centroid", points, Stroke{look.theme.series(2), 1.6 * look.metrics.hair()}, {}});
    return panel;
}

/// gainOf(k, f) is the complex or real gain of band k at f Hz.
template <typename Gain>
Panel bandsPanel(std::size_t bands, double low, double high, const Gain& gainOf, const Look& look)
{
    constexpr int points = 800;
    constexpr double floor = -60.0; // dB
    const auto level = [](auto gain)
    {
        return Decibels::fromGain(std::max(std::abs(gain), 1e-6)).value;
    };
    std::vector<Line> lines(bands, Line{"bands", {}, {}, {}});
    Line sum{"their sum", {}, Stroke{look.theme.text, 1.6 * look.metrics.hair()}, {}};
    for (int i = 0; i < points; ++i)
    {
        const double f = low * std::pow(high / low, static_cast<double>(i) / (points - 1));
        auto total = gainOf(0, f);
        for (std::size_t k = 0; k < bands; ++k)
        {
            const auto gain = gainOf(k, f);
            if (k > 0)
                total += gain;
            lines[k].points.push_back({f, level(gain)});
        }
        sum.points.push_back({f, level(total)});
    }
    Panel panel;
    panel.title = fmt::format("Response of {} bands", bands);
    panel.x = {"Frequency (Hz)", Scale::logarithmic, low, high, {}};
    panel.y = {"Gain (dB)", Scale::linear, floor, 6.0, {}};
    for (std::size_t k = 0; k < bands; ++k)
    {
        lines[k].stroke = Stroke{look.theme.series(k % 6), look.metrics.hair()};
        lines[k].listed = k == 0;
        panel.series.push_back(std::move(lines[k]));
    }
    panel.series.push_back(std::move(sum));
    return panel;
}
} // namespace

Figure makeAnalysisFigure(std::span<const float> mono, double fs, const TranslationParams& translation,
                          std::string title, TimeRange range, const FigureStyle& style)
{
    const Look look = lookFor(style);
    const auto columns = static_cast<std::size_t>(style.size.width);
    const bool isThesis = translation.method == Method::thesis;
    const auto thesis = detail::withChoices(ThesisMethodParams{}, translation.choices);
    const MethodSound sound = prepareSound(mono, fs, thesis.range);
    const Score score = isThesis ? thesisScore(sound, thesis.transients, range, columns)
                                 : ownScore(mono, fs, translation.params, range, columns);
    Figure figure{std::move(title),
                  fmt::format("Analysis by {}: {} events", methodInfo(translation.method).name, score.times.size()),
                  {envelopePanel(sound, thesis.curves, isThesis ? nullptr : &translation.params, range, style, look),
                   scorePanel(score, range, look), centroidPanel(sound, range, look)}};
    if (isThesis)
    {
        const BandLayout layout = designBandLayout(thesis.layout);
        const FilterBankCoefficients bank = designFilterBank(thesis.layout, fs);
        figure.panels.push_back(bandsPanel(
            bank.bands(), std::max(1.0, layout.centres.front().value / 2.0),
            std::min(2.0 * layout.centres.back().value, 0.49 * fs),
            [&](std::size_t k, double f) { return bank.response(k, Hertz(f), fs); }, look));
    }
    else
    {
        const auto bands = Encoder::bandsOf(translation.params);
        const BandFades fades(bands, BandAnalysisParams{}.overlap);
        figure.panels.push_back(bandsPanel(
            bands.size(), bands.front().low / 2.0, 2.0 * bands.back().high,
            [&](std::size_t k, double f) { return fades.weight(k, k, f); }, look));
    }
    return figure;
}

} // namespace pacini::plot
