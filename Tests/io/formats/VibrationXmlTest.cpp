
#include "io/formats/ClipFormat.h"
#include "io/formats/android/AndroidEffects.h"
#include "support/Catch.h"
#include "support/RandomClip.h"
#include "support/Skip.h"

#include <string>
#include <string_view>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
std::string effect(const std::string& content)
{
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<vibration-effect>\n" + content + "\n</vibration-effect>\n";
}

// Not without expat.
bool isRead()
{
    const bool reads = clipFormatNamed("android-xml")->isRead();
    if (!reads)
        skip("the vibration XML of Android is not read here");
    return reads;
}

Result<ImportedClip> readVibrationXml(std::string_view text)
{
    return clipFormatNamed("android-xml")->read(text);
}

ImportedClip read(const std::string& text)
{
    const auto imported = readVibrationXml(text);
    REQUIRE((imported.ok() ? "" : imported.error().text()) == "");
    return *imported;
}

std::string errorOf(const std::string& text)
{
    const auto imported = readVibrationXml(text);
    return imported.ok() ? "" : imported.error().text();
}

const std::vector<AndroidStep> steps{{20, 255}, {30, 0}, {40, 128}};
const std::string stepEntries = "<waveform-entry durationMs=\"20\" amplitude=\"255\"/>\n"
                                "<waveform-entry durationMs=\"30\" amplitude=\"0\"/>"
                                "<waveform-entry amplitude=\"128\" durationMs=\"40\"></waveform-entry>";
} // namespace

TEST_CASE("Vibration XML that Pacini writes says what its JSON says", "[io][formats]")
{
    if (!isRead())
        return;
    for (const std::uint64_t seed : {1, 2, 3, 4, 5})
    {
        const Clip clip = randomFullClip(seed);
        for (const char* name : {"android-xml", "android-envelope", "android-basic"})
        {
            CAPTURE(seed, name);
            const ClipFormat& format = *clipFormatNamed(name);
            const auto written = format.write(clip, {});
            REQUIRE(written);
            const auto back = format.read(written->files.front().bytes);
            REQUIRE((back.ok() ? "" : back.error().text()) == "");
            CHECK(back->warnings.empty());
            CHECK(back->clip.duration > 0.0);
            // Written again, it says the same.
            const auto again = format.write(back->clip, {});
            REQUIRE(again);
            CHECK(format.read(again->files.front().bytes)->clip.duration == Approx(back->clip.duration).margin(0.002));
        }
    }
}

TEST_CASE("Steps of vibration XML are a waveform, repeated or not", "[io][formats]")
{
    if (!isRead())
        return;
    const auto plain = read(effect("<waveform-effect>" + stepEntries + "</waveform-effect>"));
    CHECK(plain.clip == clipOfWaveform(steps));
    CHECK(plain.warnings.empty());
    const auto repeated = read(effect("<waveform-effect><repeating>" + stepEntries + "</repeating></waveform-effect>"));
    CHECK(repeated.clip == plain.clip);
    CHECK(repeated.warnings == std::vector<std::string>{"line 3: what repeats is read once"});
    const auto usual = read(effect("<waveform-effect><waveform-entry durationMs=\"20\" amplitude=\"default\"/>"
                                   "<waveform-entry durationMs=\"20\"/></waveform-effect>"));
    CHECK(usual.clip == clipOfWaveform({{20, 255}, {20, 255}}));
    CHECK(usual.warnings == std::vector<std::string>{"line 3: the device's default amplitude becomes 255"});
}

TEST_CASE("Envelopes of vibration XML are read, also those that repeat", "[io][formats]")
{
    if (!isRead())
        return;
    const std::string first = "<control-point amplitude=\"0.5\" frequencyHz=\"100\" durationMs=\"20\"/>",
                      last = "<control-point amplitude=\"0\" frequencyHz=\"200.5\" durationMs=\"30\"/>";
    const std::string open = "<waveform-envelope-effect initialFrequencyHz=\"80\">",
                      close = "</waveform-envelope-effect>";
    AndroidEnvelope envelope{80.0, {{20, 0.5, 100.0}, {30, 0.0, 200.5}}};
    CHECK(read(effect(open + first + last + close)).clip == clipOfEnvelope(envelope, false));
    const auto repeated = read(effect("<repeating-effect><preamble>" + open + first + close + "</preamble><repeating>" +
                                      "<waveform-envelope-effect>" + last + close + "</repeating></repeating-effect>"));
    CHECK(repeated.clip == clipOfEnvelope(envelope, false));
    CHECK(repeated.warnings == std::vector<std::string>{"line 3: what repeats is read once"});
    envelope.initialFrequency = 100.0;
    CHECK(read(effect("<waveform-envelope-effect>" + first + last + close)).clip == clipOfEnvelope(envelope, false));
    const auto basic = read(effect("<basic-envelope-effect initialSharpness=\"0.25\"><control-point intensity=\"1\" "
                                   "sharpness=\"0.75\" durationMs=\"10\"/></basic-envelope-effect>"));
    CHECK(basic.clip == clipOfEnvelope({0.25, {{10, 1.0, 0.75}}}, true));
    CHECK(basic.warnings ==
          std::vector<std::string>{"line 4: the last intensity is not 0; Android rejects such effects"});
}

TEST_CASE("Effects that each device has of its own are events or are named as left out", "[io][formats]")
{
    if (!isRead())
        return;
    const auto click = read(effect("<predefined-effect name=\"click\" fallback=\"false\"/>"));
    CHECK(click.clip.transients.size() == 1);
    CHECK(click.clip.duration > 0.0);
    CHECK(click.warnings ==
          std::vector<std::string>{"line 3: the effect \"click\" is each device's own and is read as an event"});
    CHECK(read(effect("<predefined-effect name=\"double_click\"/>")).clip.transients.size() == 2);
    const auto several = read(effect("<primitive-effect name=\"tick\" scale=\"0.5\" delayMs=\"100\"/>"
                                     "<primitive-effect name=\"slow_rise\"/>"
                                     "<primitive-effect name=\"thud\" delayMs=\"200\" "
                                     "delayType=\"relative_start_offset\"/>"));
    REQUIRE(several.clip.transients.size() == 2);
    CHECK(several.clip.transients[0].time == Approx(0.1));
    CHECK(several.clip.transients[1].time == Approx(0.3));
    CHECK(several.clip.transients[1].sharpness < several.clip.transients[0].sharpness);
    CHECK(several.warnings.size() == 3);
    CHECK(several.warnings[1] == "line 3: the effect \"slow_rise\" is each device's own and is left out");
    CHECK(errorOf(effect("<primitive-effect name=\"spin\"/>")).ends_with("has no effect that can be read"));
    const auto chosen =
        read("<vibration-select><vibration-effect><vendor-effect>AAAA</vendor-effect></vibration-effect>\n"
             "<vibration-effect><predefined-effect name=\"tick\"/></vibration-effect>\n"
             "<vibration-effect><predefined-effect name=\"click\"/></vibration-effect></vibration-select>");
    CHECK(chosen.clip.transients.size() == 1);
    CHECK(chosen.warnings ==
          std::vector<std::string>{"line 1: vendor-effect cannot be read and is left out",
                                   "line 2: the effect \"tick\" is each device's own and is read as an event",
                                   "line 3: of several vibration-effects the first that can be read is taken"});
}

TEST_CASE("Broken vibration XML is refused with its line, unknown parts are named", "[io][formats]")
{
    if (!isRead())
        return;
    const auto entry = [](const std::string& attributes)
    {
        return effect("<waveform-effect><waveform-entry " + attributes + "/></waveform-effect>");
    };
    CHECK(errorOf("").starts_with("line 1: is no XML: "));
    CHECK(errorOf("<a/>") == "line 1: the root is a, but must be vibration-effect");
    CHECK(errorOf("<vibration-effect/>") == "line 1: has no effect that can be read");
    CHECK(errorOf("<vibration-select/>") == "line 1: has no vibration-effect");
    CHECK(errorOf(effect("<waveform-effect>")).starts_with("line 4: is no XML: "));
    CHECK(errorOf(effect("<waveform-effect/>")) == "line 4: waveform-effect has no entry that lasts");
    CHECK(errorOf(entry("amplitude=\"1\"")) == "line 3: has no durationMs");
    CHECK(errorOf(entry("durationMs=\"1.5\"")) == "line 3: durationMs is \"1.5\", but must be a whole number");
    CHECK(errorOf(entry("durationMs=\"-1\"")).starts_with("line 3: durationMs is \"-1\", but must be a number from 0"));
    CHECK(errorOf(entry("durationMs=\"1e300\"")).starts_with("line 3: durationMs is"));
    CHECK(errorOf(entry("durationMs=\"nan\"")).starts_with("line 3: durationMs is"));
    CHECK(errorOf(entry("durationMs=\"10\" amplitude=\"256\"")).starts_with("line 3: amplitude is \"256\""));
    CHECK(errorOf(effect("<waveform-effect><waveform-entry durationMs=\"86400000\"/><waveform-entry durationMs=\"1\"/>"
                         "</waveform-effect>")) == "line 3: ends later than 24 hours");
    CHECK(errorOf(effect("<predefined-effect/>")) == "line 3: predefined-effect has no name");
    CHECK(
        errorOf(effect("<waveform-effect>" + stepEntries + "</waveform-effect><predefined-effect name=\"click\"/>")) ==
        "line 4: predefined-effect follows waveform-effect, but a vibration-effect has only one effect");
    CHECK(errorOf(effect("<waveform-envelope-effect><control-point amplitude=\"2\" frequencyHz=\"100\" "
                         "durationMs=\"20\"/></waveform-envelope-effect>"))
              .starts_with("line 3: amplitude is \"2\""));
    CHECK(errorOf("<!DOCTYPE a [<!ENTITY b \"c\">]>\n<vibration-effect/>") == "line 1: has a document type; remove it");
    std::string deep;
    for (int i = 0; i < 100'000; ++i)
        deep += "<a>";
    CHECK(errorOf("<vibration-effect>" + deep).starts_with("line 1: is no XML: "));
    const auto odd = read(
        effect("<new-effect><a/></new-effect><waveform-effect speed=\"1\">" + stepEntries + "<b/></waveform-effect>"));
    CHECK(odd.clip == clipOfWaveform(steps));
    CHECK(odd.warnings == std::vector<std::string>{"line 3: new-effect cannot be read and is left out",
                                                   "line 3: speed of waveform-effect cannot be read and is left out",
                                                   "line 4: b cannot be read and is left out"});
    // Whatever is cut off is refused.
    const auto whole = effect("<waveform-effect>" + stepEntries + "</waveform-effect>");
    for (std::size_t length = 0; length + 1 < whole.size(); ++length)
        CHECK_FALSE(readVibrationXml(std::string_view(whole).substr(0, length)));
}
