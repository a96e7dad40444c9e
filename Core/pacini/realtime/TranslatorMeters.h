#pragma once

// Meters of the translator.

#include <pacini/foundation/Units.h>
#include <pacini/realtime/TranslatorSetup.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace pacini
{

/// A reading of the meters.
struct TranslatorMeterReading
{
    std::array<double, maxTranslatorBands> bandLevels{}; ///< dB of the source's band, 0 = full scale sine; -infinity
    std::size_t bands = 0;
    std::uint32_t events = 0;         ///< since reset, modulo 2^32: a lamp lights when it changes
    std::uint64_t lastEventFrame = 0; ///< of the input, where the newest event begins
    double lastEventLevel = 0.0;      ///< linear
    double outputPeak = 0.0;          ///< linear, of the last call
    double gainReduction = 0.0;       ///< dB, of limiter or protection in the last call
    double overThreshold = 0.0;       ///< dB of the drive above the touch threshold; negative: below
};

/// Meters of the translator. One writer, any number of readers, no locks: every number is a separate atomic. Numbers of
/// one reading may come from neighbouring blocks; the difference is invisible.
class TranslatorMeters
{
public:
    /// [any]
    [[nodiscard]] TranslatorMeterReading read() const noexcept
    {
        TranslatorMeterReading reading;
        reading.bands = bands.load(std::memory_order_relaxed);
        for (std::size_t k = 0; k < reading.bands; ++k)
            reading.bandLevels[k] =
                Decibels::fromPower(static_cast<double>(powers[k].load(std::memory_order_relaxed))).value;
        reading.events = events.load(std::memory_order_acquire);
        reading.lastEventFrame = lastEventFrame.load(std::memory_order_relaxed);
        reading.lastEventLevel = static_cast<double>(lastEventLevel.load(std::memory_order_relaxed));
        reading.outputPeak = static_cast<double>(outputPeak.load(std::memory_order_relaxed));
        reading.gainReduction = static_cast<double>(gainReduction.load(std::memory_order_relaxed));
        reading.overThreshold = Decibels::fromGain(reading.outputPeak).value +
                                static_cast<double>(feltRange.load(std::memory_order_relaxed));
        return reading;
    }

    /// Power of a band, 1 for a sine of full scale. [audio]
    void setBand(std::size_t k, double power) noexcept
    {
        powers[k].store(static_cast<float>(power), std::memory_order_relaxed);
    }
    void setBands(std::size_t count, double range) noexcept
    {
        bands.store(count, std::memory_order_relaxed);
        feltRange.store(static_cast<float>(range), std::memory_order_relaxed);
    }
    void noteEvent(std::uint64_t frame, double level) noexcept
    {
        lastEventFrame.store(frame, std::memory_order_relaxed);
        lastEventLevel.store(static_cast<float>(level), std::memory_order_relaxed);
        events.store(events.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    }
    void setOutput(double peak, double reduction) noexcept
    {
        outputPeak.store(static_cast<float>(peak), std::memory_order_relaxed);
        gainReduction.store(static_cast<float>(reduction), std::memory_order_relaxed);
    }
    void reset() noexcept
    {
        for (auto& power : powers)
            power.store(0.0f, std::memory_order_relaxed);
        setOutput(0.0, 0.0);
        events.store(0, std::memory_order_relaxed);
        lastEventFrame.store(0, std::memory_order_relaxed);
        lastEventLevel.store(0.0f, std::memory_order_relaxed);
    }

private:
    std::array<std::atomic<float>, maxTranslatorBands> powers{};
    std::atomic<std::size_t> bands{0};
    std::atomic<std::uint32_t> events{0};
    std::atomic<std::uint64_t> lastEventFrame{0};
    std::atomic<float> lastEventLevel{0.0f};
    std::atomic<float> outputPeak{0.0f};
    std::atomic<float> gainReduction{0.0f};
    std::atomic<float> feltRange{60.0f};
};

static_assert(std::atomic<float>::is_always_lock_free && std::atomic<std::uint64_t>::is_always_lock_free);

} // namespace pacini
