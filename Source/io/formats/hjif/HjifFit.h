#pragma once

// Least-squares fit of keyframes to the amplitudes of waves.

#include <pacini/clip/Clip.h>

#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Fits curves of few points to the dense amplitudes of a clip's bands. Where a band gets a point is decided by the
/// error in dB that it saves there; which values the points then have by all bands together: they are the ones whose
/// waves have the least squared error against the waves that the dense amplitudes make, relative to the level there.
/// What one band has to leave out, its neighbours make good where they can.
class HjifFit
{
public:
    static constexpr double step = 0.005; ///< s, between the places that points can have

    HjifFit() = default;

    /// `clip` has pitches and no envelope. Errors fade out below `floor`: they are hardly felt. With `joint`, points
    /// get their values together; it takes 100 kB per second of the clip.
    HjifFit(const Clip& clip, double floor, bool joint);

    /// Places of points.
    [[nodiscard]] std::size_t steps() const noexcept { return count; }

    /// A curve for each band. A point is worth `price` dB^2 steps, its error counts `need` times at each step.
    [[nodiscard]] std::vector<Curve> curves(double price, std::span<const double> need) const;

private:
    /// Products of the waves over the interval after a step, weighted by the place in it: from both sides of the
    /// interval, and one each.
    struct Products
    {
        float first = 0.0f, mixed = 0.0f, second = 0.0f;
    };

    void multiplyWaves(const Clip& clip);
    [[nodiscard]] Products& products(std::size_t interval, std::size_t a, std::size_t b);
    [[nodiscard]] const Products& products(std::size_t interval, std::size_t a, std::size_t b) const;
    [[nodiscard]] Curve separately(std::size_t band, double price, std::span<const double> need) const;
    void together(std::vector<Curve>& curves) const;

    double duration = 0.0, floor = 0.0;
    std::size_t count = 0;
    std::vector<std::vector<double>> levels; ///< of each band at each step
    std::vector<double> sums;                ///< of all bands at each step
    std::vector<Products> pairs;             ///< of each interval and each pair of bands
    std::vector<std::vector<double>> wanted; ///< for each band, the weighted product with the whole at each step
};

} // namespace pacini
