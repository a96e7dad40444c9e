#pragma once

// Starting values for a further equalizer section: where it may help.

#include <pacini/linearize/EqualizerFitProblem.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pacini
{

/// Proposes sections by matching pursuit (S. Mallat, Z. Zhang, "Matching pursuits with time-frequency dictionaries",
/// 1993): of a dictionary of peaks and shelves those that take most from the deviation from flat. The dictionary holds
/// the shapes at small gains, where levels are proportional to the gain and cost no logarithm, on 64 means of the
/// points. What is narrower than these can show is found at the largest deviation itself.
class EqualizerStart
{
public:
    explicit EqualizerStart(const EqualizerFitProblem& fitted) : problem(fitted)
    {
        makeBlocks();
        constexpr double perOctave = 4.0;
        const double low = problem.frequency[0];
        const double ratio = std::min(problem.frequency[problem.points() - 1], problem.highestFrequency) / low;
        const int steps = std::clamp(static_cast<int>(perOctave * std::log2(ratio)), 4, 40);
        for (int i = 0; i <= steps; ++i)
        {
            const double f = std::max(low * std::pow(ratio, static_cast<double>(i) / steps), problem.lowestFrequency);
            for (const double q : {0.5, 1.0, 2.0, 4.0})
                if (q <= problem.highestQ)
                    addAtom(EqualizerType::peak, f, q);
            if (problem.shelves && i % 2 == 0)
                addAtom(EqualizerType::lowShelf, f, 0.7);
        }
    }

    /// Up to three different sections for the deviation (dB, one per point in the range): the best peak, the one at the
    /// largest deviation if that is another, and the best shelf.
    [[nodiscard]] std::vector<EqualizerSection> proposals(const std::vector<double>& deviation) const
    {
        const std::vector<double> means = blockMeans(deviation);
        Scored peak, shelf;
        for (const Atom& atom : atoms)
        {
            double product = 0.0;
            for (std::size_t b = 0; b < means.size(); ++b)
                product += atom.shape[b] * means[b];
            const bool isPeak = atom.section.type == EqualizerType::peak;
            Scored& best = isPeak ? peak : shelf;
            const double score = product * product / atom.energy;
            if (score <= best.score)
                continue;
            best = {score, atom.section};
            best.section.gain = std::clamp(-product / atom.energy, -maxGain, isPeak ? problem.maxBoost : maxGain);
        }
        std::vector<EqualizerSection> chosen;
        if (peak.score > 0.0)
            chosen.push_back(peak.section);
        const Scored narrow = atLargest(deviation);
        const bool alike = peak.score > 0.0 && narrow.section.q <= 1.5 * peak.section.q &&
                           std::abs(std::log(narrow.section.frequency / peak.section.frequency)) <= 0.5;
        if (narrow.score > 0.0 && !alike)
            chosen.push_back(narrow.section);
        if (shelf.score > 0.0)
            chosen.push_back(shelf.section);
        return chosen;
    }

private:
    static constexpr double maxGain = 30.0; ///< dB, to start from

    struct Atom
    {
        EqualizerSection section;
        std::vector<double> shape; ///< per dB of gain, less its mean, times the weight
        double energy = 0.0;
    };
    struct Scored
    {
        double score = 0.0; ///< dB^2 taken from the weighted sum of squares
        EqualizerSection section;
    };

    void makeBlocks()
    {
        constexpr std::size_t maxBlocks = 64;
        const std::size_t n = problem.points();
        const std::size_t blocks = std::min(n, maxBlocks);
        for (std::size_t b = 0; b <= blocks; ++b)
            edges.push_back(b * n / blocks);
        weight.assign(blocks, 0.0);
        for (std::size_t b = 0; b < blocks; ++b)
        {
            warped.push_back(problem.warped[(edges[b] + edges[b + 1]) / 2]);
            for (std::size_t i = edges[b]; i < edges[b + 1]; ++i)
                weight[b] += problem.weight[i];
            total += weight[b];
        }
    }

    [[nodiscard]] std::vector<double> blockMeans(const std::vector<double>& deviation) const
    {
        std::vector<double> means(weight.size(), 0.0);
        for (std::size_t b = 0; b < means.size(); ++b)
        {
            for (std::size_t i = edges[b]; i < edges[b + 1]; ++i)
                means[b] += problem.weight[i] * deviation[i];
            if (weight[b] > 0.0)
                means[b] /= weight[b];
        }
        return means;
    }

    void addAtom(EqualizerType type, double frequency, double q)
    {
        constexpr double least = 1e-6; // of the energy of an atom that any of the blocks sees
        const double scale = 1.0 / warpedSquare(frequency, problem.fs);
        Atom atom{{type, frequency, 0.0, q}, {}, 0.0};
        atom.shape.reserve(warped.size());
        double mean = 0.0;
        for (std::size_t b = 0; b < warped.size(); ++b)
        {
            const double t = warped[b] * scale;
            const double width = t / (q * q);
            const double below = 1.0 / ((1.0 - t) * (1.0 - t) + width);
            // the limits of level / gain for gains near 0 (see SectionCurve)
            const double shape = type == EqualizerType::peak ? width * below : 0.5 + 0.5 * (1.0 - t * t) * below;
            atom.shape.push_back(shape);
            mean += weight[b] * shape;
        }
        mean /= total;
        for (std::size_t b = 0; b < warped.size(); ++b)
        {
            const double shape = atom.shape[b] - mean;
            atom.energy += weight[b] * shape * shape;
            atom.shape[b] = weight[b] * shape;
        }
        if (atom.energy > least * total)
            atoms.push_back(std::move(atom));
    }

    /// A peak on the largest deviation, as wide as that is at half its height.
    [[nodiscard]] Scored atLargest(const std::vector<double>& deviation) const
    {
        const std::size_t n = problem.points();
        const auto countedSize = [&](std::size_t i)
        {
            return std::abs(deviation[i]) * std::min(1.0, problem.weight[i]);
        };
        std::size_t at = 0;
        for (std::size_t i = 1; i < n; ++i)
            if (countedSize(i) > countedSize(at))
                at = i;
        if (countedSize(at) <= 0.0)
            return {};
        const double height = deviation[at];
        const auto belongs = [&](std::size_t i)
        {
            return deviation[i] / height > 0.5;
        };
        std::size_t left = at, right = at;
        while (left > 0 && belongs(left - 1))
            --left;
        while (right + 1 < n && belongs(right + 1))
            ++right;
        Scored found;
        for (std::size_t i = left; i <= right; ++i)
            found.score += problem.weight[i] * deviation[i] * deviation[i];
        const double width =
            std::log(problem.frequency[std::min(right + 1, n - 1)] / problem.frequency[left > 0 ? left - 1 : 0]);
        found.section = {EqualizerType::peak,
                         std::clamp(problem.frequency[at], problem.lowestFrequency, problem.highestFrequency),
                         std::clamp(-height, -maxGain, problem.maxBoost),
                         std::clamp(1.0 / width, problem.lowestQ, problem.highestQ)};
        return found;
    }

    const EqualizerFitProblem& problem;
    std::vector<std::size_t> edges; ///< of the blocks, in points
    std::vector<double> warped, weight;
    double total = 0.0;
    std::vector<Atom> atoms;
};

} // namespace pacini
