// What ends an imported clip is felt too.

#include "io/formats/ClipFormat.h"
#include "io/formats/ImportReport.h"
#include "io/formats/samples/DriveSamples.h"
#include "support/Catch.h"

#include <cmath>
#include <string>

using namespace pacini;

namespace
{
/// Files whose last event stands at 0.3 s, where nothing follows.
struct Sample
{
    const char* format;
    std::string text;
};

const Sample samples[] = {
    {"ahap", R"({"Version": 1, "Pattern": [{"Event": {"Time": 0.3, "EventType": "HapticTransient"}}]})"},
    {"ahap", R"({"Version": 1, "Pattern": [
        {"Event": {"Time": 0, "EventType": "HapticContinuous", "EventDuration": 0.3}},
        {"Event": {"Time": 0.3, "EventType": "HapticTransient"}}]})"},
    {"haptic", R"({"version": {"major": 1}, "signals": {"continuous": {"envelopes": {"amplitude": [
        {"time": 0, "amplitude": 0.2},
        {"time": 0.3, "amplitude": 0.4, "emphasis": {"amplitude": 0.8, "frequency": 0.1}}]}}}})"},
    {"csv", "time,event,sharpness\n0,,\n0.3,0.9,0.2\n"},
    {"haps", R"({"m_version": "5", "m_vibration": {"m_melodies": [{"m_notes": [
        {"m_startingPoint": 0.3, "m_hapticEffect": {"m_type": 0}}]}]}})"},
};
} // namespace

TEST_CASE("A clip that is imported lasts until its last event has sounded", "[io][formats]")
{
    for (const Sample& sample : samples)
    {
        CAPTURE(sample.format, sample.text);
        const auto read = clipFormatNamed(sample.format)->read(sample.text);
        REQUIRE((read.ok() ? "" : read.error().text()) == "");
        REQUIRE(read->clip.transients.size() == 1);
        CHECK(read->clip.duration > 0.305);
        CHECK(read->clip.duration < 0.33);
        for (const Band& band : read->clip.bands) // which ended at 0.3 s
            CHECK(valueAt(band.amplitude, 0.304) == 0.0);
        Clip tap = read->clip;
        tap.bands.clear();
        tap.envelope.clear();
        const auto drives = driveSignal(tap, 48000.0, {});
        REQUIRE(drives.ok());
        double peak = 0.0;
        for (const float drive : *drives)
            peak = std::max(peak, static_cast<double>(std::abs(drive)));
        CHECK(peak > 0.7 * tap.transients[0].amplitude);
    }
}

TEST_CASE("Clips that end with an event do not grow from one export to the next", "[io][formats]")
{
    for (const Sample& sample : samples)
        for (const ClipFormat& format : clipFormats())
        {
            if (!format.isRead() || !format.isWritten() || format.name == "tact")
                continue;
            CAPTURE(sample.format, format.name);
            Clip clip = clipFormatNamed(sample.format)->read(sample.text)->clip;
            const auto once = format.read(format.write(clip, {})->files[0].bytes);
            REQUIRE(once.ok());
            clip = once->clip;
            for (int i = 0; i < 4; ++i)
                clip = format.read(format.write(clip, {})->files[0].bytes)->clip;
            CHECK(clip.duration == once->clip.duration);
        }
}

TEST_CASE("An ending that is only rounded stays as it is", "[io][formats]")
{
    Clip clip;
    clip.transients = {{1.0, 0.5, 0.5}};
    lastUntilSounded(clip);
    const double needed = clip.duration;
    clip.duration = needed - 0.0004;
    lastUntilSounded(clip);
    CHECK(clip.duration == needed - 0.0004);
    clip.duration = needed - 0.001;
    lastUntilSounded(clip);
    CHECK(clip.duration == needed);
    clip.transients = {{limits::duration, 0.5, 0.5}};
    lastUntilSounded(clip);
    CHECK(clip.duration == limits::duration);
}
