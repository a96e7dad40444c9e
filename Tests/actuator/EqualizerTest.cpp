#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/actuator/Equalizer.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

std::string wrongSections(const EqualizerSections& sections)
{
    const auto valid = validate(sections, "eq");
    if (valid.ok())
        return {};
    CHECK(valid.error().code == ErrorCode::invalidData);
    return valid.error().text();
}

} // namespace

TEST_CASE("An equaliser's numbers are in their ranges, ends included", "[actuator]")
{
    const EqualizerSection good;
    CHECK(wrongSections({}).empty());
    CHECK(wrongSections({good, good}).empty());
    const auto check = [&](const std::string& name, double EqualizerSection::*member, double low, double high,
                           const std::string& message)
    {
        CAPTURE(name);
        const auto with = [&](double value)
        {
            EqualizerSection section = good;
            section.*member = value;
            return wrongSections({good, section});
        };
        CHECK(with(low).empty());
        CHECK(with(high).empty());
        CHECK(with(low - 1e-9 * std::abs(low)) == "eq[1]." + name + ": must be " + message);
        CHECK(with(high + 1e-9 * std::abs(high)) == "eq[1]." + name + ": must be " + message);
        CHECK(with(std::nan("")) == "eq[1]." + name + ": must be " + message);
    };
    check("frequency", &EqualizerSection::frequency, 1.0, 20000.0, "1 to 20000 Hz");
    check("gain", &EqualizerSection::gain, -40.0, 40.0, "-40 to 40 dB");
    check("q", &EqualizerSection::q, 0.01, 100.0, "0.01 to 100");
    for (const int order : {0, 1, 8, 9})
    {
        EqualizerSection section = good;
        section.order = order;
        CHECK(wrongSections({section}) == (order == 0 || order == 9 ? "eq[0].order: must be 1 to 8" : ""));
    }
}

TEST_CASE("All sections of an equaliser together are at most 32 of second order", "[actuator]")
{
    // High-passes of order n count n / 2, rounded up; all others 1, whatever their order says.
    const EqualizerSection four{EqualizerType::highpass, 20.0, 0.0, 1.0, 8};
    const EqualizerSection alsoFour{EqualizerType::highpass, 20.0, 0.0, 1.0, 7};
    const EqualizerSection one{EqualizerType::highpass, 20.0, 0.0, 1.0, 1};
    const EqualizerSection peak{EqualizerType::peak, 20.0, 0.0, 1.0, 8};
    const std::string message = "is too high: high-passes count with half their order, at most 32 together";
    CHECK(wrongSections({four, four, four, four, four, four, four, four}).empty());
    CHECK(wrongSections({four, four, four, four, four, four, four, alsoFour, one}) == "eq[8]: " + message);
    CHECK(wrongSections({four, four, four, four, four, four, four, peak, peak, peak, peak}).empty());
    CHECK(wrongSections({four, four, four, four, four, four, four, peak, peak, peak, one, peak}) ==
          "eq[11]: " + message);
    EqualizerSections sixteen;
    for (int i = 0; i < 16; ++i)
        sixteen.pushBack(peak);
    CHECK(wrongSections(sixteen).empty());
}

TEST_CASE("A new section of an equaliser is a flat peak", "[actuator]")
{
    CHECK(EqualizerSection{} == EqualizerSection{EqualizerType::peak, 100.0, 0.0, std::sqrt(0.5), 2});
}

TEST_CASE("Sections of an equaliser do at their frequencies what their types say", "[actuator]")
{
    const double fs = 48000.0;
    const auto level = [&](const EqualizerSections& sections, double f)
    {
        return 20.0 * std::log10(std::abs(designEqualizer(sections, fs).response(Hertz(f), fs)));
    };
    const EqualizerSections peak{{EqualizerType::peak, 100.0, 7.0, 2.0, 5}};
    CHECK(level(peak, 100.0) == Approx(7.0));
    CHECK(level(peak, 1.0) == Approx(0.0).margin(1e-2));
    CHECK(level(peak, 5000.0) == Approx(0.0).margin(1e-2));
    const EqualizerSections low{{EqualizerType::lowShelf, 100.0, 7.0, 0.7, 5}};
    CHECK(level(low, 1.0) == Approx(7.0).margin(1e-2));
    CHECK(level(low, 100.0) == Approx(3.5));
    CHECK(level(low, 5000.0) == Approx(0.0).margin(1e-2));
    const EqualizerSections high{{EqualizerType::highShelf, 100.0, 7.0, 0.7, 5}};
    CHECK(level(high, 1.0) == Approx(0.0).margin(1e-2));
    CHECK(level(high, 100.0) == Approx(3.5));
    CHECK(level(high, 5000.0) == Approx(7.0).margin(1e-2));
    for (int order = 1; order <= 8; ++order)
    {
        CAPTURE(order);
        const EqualizerSections highpass{{EqualizerType::highpass, 100.0, 7.0, 0.7, order}};
        CHECK(designEqualizer(highpass, fs).sections.size() == static_cast<std::size_t>(order + 1) / 2);
        // Butterworth: 1 / (1 + (fc / f)^(2 n)), nearly, so far below the sample rate.
        for (const double f : {25.0, 50.0, 100.0, 300.0})
            CHECK(level(highpass, f) ==
                  Approx(-10.0 * std::log10(1.0 + std::pow(100.0 / f, 2.0 * order))).margin(1e-3));
    }
    CHECK(level({peak[0], low[0], high[0]}, 60.0) == Approx(level(peak, 60.0) + level(low, 60.0) + level(high, 60.0)));
}

TEST_CASE("Sections from 0.49 of the sample rate on are left out of an equaliser", "[actuator]")
{
    for (const EqualizerType type :
         {EqualizerType::peak, EqualizerType::lowShelf, EqualizerType::highShelf, EqualizerType::highpass})
    {
        const double fs = 8000.0;
        const EqualizerSection after{EqualizerType::peak, 100.0, 3.0, 1.0, 2};
        CHECK(designEqualizer({{type, 0.49 * fs, 6.0, 1.0, 2}, after}, fs) == designEqualizer({after}, fs));
        CHECK(designEqualizer({{type, 5000.0, 6.0, 1.0, 2}, after}, fs) == designEqualizer({after}, fs));
        CHECK(designEqualizer({{type, 3919.9, 6.0, 1.0, 2}, after}, fs).sections.size() == 2);
    }
}
