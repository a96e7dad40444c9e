#pragma once

// Resonance fit: frequency and Q of a measured response.

#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>
#include <pacini/linearize/FrequencyResponse.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pacini
{

/// Resonance model g (f / f0)^slope / |1 - (f / f0)^2 + i f / (Q f0)|
struct ResonanceModel
{
    double frequency = 67.0; ///< f0, Hz
    double q = 1.0;
    double gain = 0.0;  ///< dB, at f far above f0 for slope 2, far below for 0, at the peak for 1 times Q
    int slope = 2;      ///< 2 acceleration of a driven mass, 1 velocity, 0 displacement
    double error = 0.0; ///< dB, root mean square over the points that were fitted

    /// The level, dB, at f Hz, averaged in power over `octaves` around it.
    [[nodiscard]] double level(double f, double octaves = 0.0) const noexcept
    {
        constexpr int steps = 16; // of Simpson's rule: 1/100 of a dB for Q 40 under 1/12 octave
        if (!(octaves > 0.0))
            return gain + Decibels::fromPower(power(f)).value;
        double sum = 0.0;
        for (int i = 0; i <= steps; ++i)
        {
            const double weight = i == 0 || i == steps ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
            sum += weight * power(f * std::exp2(octaves * (static_cast<double>(i) / steps - 0.5)));
        }
        return gain + Decibels::fromPower(sum / (3.0 * steps)).value;
    }

private:
    [[nodiscard]] double power(double f) const noexcept
    {
        const double x = (f / frequency) * (f / frequency);
        const double real = 1.0 - x;
        const double numerator = slope == 2 ? x * x : (slope == 1 ? x : 1.0);
        return numerator / (real * real + x / (q * q));
    }
};

namespace detail
{
/// Points of a response and a model's fit to them; the gain follows from the other two by the mean.
class ResonanceProblem
{
public:
    ResonanceProblem(const FrequencyResponse& response, double low, double high, double octaves) : smoothing(octaves)
    {
        // More points than this add nothing but time.
        constexpr std::size_t most = 400;
        std::vector<std::size_t> within;
        for (std::size_t i = 0; i < response.size(); ++i)
            if (response.frequency[i] >= low && response.frequency[i] <= high)
                within.push_back(i);
        const std::size_t stride = within.size() / most + 1;
        for (std::size_t i = 0; i < within.size(); i += stride)
        {
            frequency.push_back(response.frequency[within[i]]);
            level.push_back(response.level[within[i]]);
        }
    }

    [[nodiscard]] std::size_t size() const noexcept { return frequency.size(); }

    /// Sets gain and error of the model; `residual` gets one value per point.
    void evaluate(ResonanceModel& model, std::vector<double>& residual) const
    {
        residual.resize(size());
        model.gain = 0.0;
        double mean = 0.0;
        for (std::size_t i = 0; i < size(); ++i)
        {
            residual[i] = level[i] - model.level(frequency[i], smoothing);
            mean += residual[i];
        }
        mean /= static_cast<double>(size());
        model.gain = mean;
        double squares = 0.0;
        for (double& r : residual)
        {
            r -= mean;
            squares += r * r;
        }
        model.error = std::sqrt(squares / static_cast<double>(size()));
    }

    /// Levenberg-Marquardt on log f0 and log Q from `model` on.
    [[nodiscard]] ResonanceModel refined(ResonanceModel model) const
    {
        std::vector<double> residual;
        std::vector<double> moved;
        evaluate(model, residual);
        double damping = 1e-3;
        for (int step = 0; step < 60 && damping < 1e9; ++step)
        {
            constexpr double difference = 1e-5;
            std::array<std::vector<double>, 2> slope;
            for (std::size_t p = 0; p < 2; ++p)
            {
                auto other = model;
                (p == 0 ? other.frequency : other.q) *= std::exp(difference);
                evaluate(other, moved);
                for (std::size_t i = 0; i < size(); ++i)
                    slope[p].push_back((moved[i] - residual[i]) / difference);
            }
            const auto dot = [](const std::vector<double>& a, const std::vector<double>& b)
            {
                double sum = 0.0;
                for (std::size_t i = 0; i < a.size(); ++i)
                    sum += a[i] * b[i];
                return sum;
            };
            const double ff = dot(slope[0], slope[0]) * (1.0 + damping);
            const double qq = dot(slope[1], slope[1]) * (1.0 + damping);
            const double fq = dot(slope[0], slope[1]);
            const double f = dot(slope[0], residual);
            const double q = dot(slope[1], residual);
            const double determinant = ff * qq - fq * fq;
            if (!(determinant > 0.0))
                break;
            auto next = model;
            next.frequency *= std::exp(std::clamp(-(qq * f - fq * q) / determinant, -0.3, 0.3));
            next.q = std::clamp(next.q * std::exp(std::clamp(-(ff * q - fq * f) / determinant, -0.5, 0.5)), 0.1, 1e3);
            evaluate(next, moved);
            if (next.error < model.error)
            {
                const bool settled = model.error - next.error < 1e-9 * model.error;
                model = next;
                residual = moved;
                damping = std::max(damping * 0.3, 1e-9);
                if (settled)
                    break;
            }
            else
                damping *= 5.0;
        }
        return model;
    }

private:
    double smoothing;
    std::vector<double> frequency;
    std::vector<double> level;
};
} // namespace detail

/// Fits the second-order model of the best slope to the levels of `response`, which has been smoothed over `octaves`
/// (the model is smoothed alike, so that its Q is that of the thing and not of its smoothed peak). All points near the
/// peak take part, not just the three of the -3 dB rule, which noise moves and which a Q below 1 does not have. First
/// over the whole range from `low` to `high` Hz, then, for a Q above 2, around the peak only: other parts of a device
/// have resonances too. Errors: those of validate(response); truncated at `points` for fewer than eight in the range.
[[nodiscard]] inline Result<ResonanceModel> fitResonance(const FrequencyResponse& response, double low, double high,
                                                         double octaves = 0.0)
{
    if (auto valid = validate(response); !valid)
        return valid.error();
    const detail::ResonanceProblem whole(response, low, high, octaves);
    if (whole.size() < FrequencyResponse::fewestPoints)
        return Error{ErrorCode::truncated, "points", "has fewer than 8 points in the range of the resonance"};
    const double first = std::max(low, response.frequency.front());
    const double last = std::min(high, response.frequency.back());
    std::vector<double> residual;
    ResonanceModel best;
    best.error = 1e300;
    for (const int slope : {0, 1, 2})
        for (const double q : {0.6, 1.2, 3.0, 8.0, 20.0, 40.0})
        {
            constexpr int places = 48;
            for (int i = 0; i <= places; ++i)
            {
                ResonanceModel model{first * std::pow(last / first, static_cast<double>(i) / places), q, 0.0, slope,
                                     0.0};
                whole.evaluate(model, residual);
                if (model.error < best.error)
                    best = model;
            }
        }
    best = whole.refined(best);
    if (best.q <= 2.0)
        return best;
    // Twice: the reach follows from the Q, which the first, wider fit has from other things too.
    for (int pass = 0; pass < 2; ++pass)
    {
        const double reach = std::exp2(std::clamp(4.0 / best.q, 0.25, 1.5) + octaves);
        const detail::ResonanceProblem around(response, best.frequency / reach, best.frequency * reach, octaves);
        if (around.size() < FrequencyResponse::fewestPoints)
            break;
        best = around.refined(best);
    }
    return best;
}

} // namespace pacini
