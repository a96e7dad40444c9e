
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
std::string xmlEffect(const std::string& content)
{
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<vibration-effect>\n" + content + "\n</vibration-effect>\n";
}

// Not without expat.
bool readsXml()
{
    const bool reads = clipFormatNamed("android-xml")->isRead();
    if (!reads)
        skip("the vibration XML of Android is not read here");
    return reads;
}

Result<ImportedClip> xmlClip(std::string_view text)
{
    return clipFormatNamed("android-xml")->read(text);
}

ImportedClip readXml(const std::string& text)
{
    const auto imported = xmlClip(text);
    REQUIRE((imported.ok() ? "" : imported.error().text()) == "");
    return *imported;
}

std::string xmlErrorOf(const std::string& text)
{
    const auto imported = xmlClip(text);
    return imported.ok() ? "" : imported.error().text();
}

const std::vector<AndroidStep> xmlSteps{{20, 255}, {30, 0}, {40, 128}};
const std::string xmlStepEntries = "<waveform-entry durationMs=\"20\" amplitude=\"255\"/>\n"
                                   "<waveform-entry durationMs=\"30\" amplitude=\"0\"/>"
                                   "<waveform-entry amplitude=\"128\" durationMs=\"40\"></waveform-entry>";
} // namespace

TEST_CASE("Vibration XML that Pacini writes says what its JSON says", "[io][formats]")
{
    if (!readsXml())
        return;
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u})
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
    if (!readsXml())
        return;
    const auto plain = readXml(xmlEffect("<waveform-effect>" + xmlStepEntries + "</waveform-effect>"));
    CHECK(plain.clip == clipOfWaveform(xmlSteps));
    CHECK(plain.warnings.empty());
    const auto repeated =
        readXml(xmlEffect("<waveform-effect><repeating>" + xmlStepEntries + "</repeating></waveform-effect>"));
    CHECK(repeated.clip == plain.clip);
    CHECK(repeated.warnings == std::vector<std::string>{"line 3: what repeats is read once"});
    const auto usual = readXml(xmlEffect("<waveform-effect><waveform-entry durationMs=\"20\" amplitude=\"default\"/>"
                                         "<waveform-entry durationMs=\"20\"/></waveform-effect>"));
    CHECK(usual.clip == clipOfWaveform({{20, 255}, {20, 255}}));
    CHECK(usual.warnings == std::vector<std::string>{"line 3: the device's default amplitude becomes 255"});
}

TEST_CASE("Envelopes of vibration XML are read, also those that repeat", "[io][formats]")
{
    if (!readsXml())
        return;
    const std::string first = "<control-point amplitude=\"0.5\" frequencyHz=\"100\" durationMs=\"20\"/>",
                      last = "<control-point amplitude=\"0\" frequencyHz=\"200.5\" durationMs=\"30\"/>";
    const std::string open = "<waveform-envelope-effect initialFrequencyHz=\"80\">",
                      close = "</waveform-envelope-effect>";
    AndroidEnvelope envelope{80.0, {{20, 0.5, 100.0}, {30, 0.0, 200.5}}};
    CHECK(readXml(xmlEffect(open + first + last + close)).clip == clipOfEnvelope(envelope, false));
    const auto repeated =
        readXml(xmlEffect("<repeating-effect><preamble>" + open + first + close + "</preamble><repeating>" +
                          "<waveform-envelope-effect>" + last + close + "</repeating></repeating-effect>"));
    CHECK(repeated.clip == clipOfEnvelope(envelope, false));
    CHECK(repeated.warnings == std::vector<std::string>{"line 3: what repeats is read once"});
    envelope.initialFrequency = 100.0;
    CHECK(readXml(xmlEffect("<waveform-envelope-effect>" + first + last + close)).clip ==
          clipOfEnvelope(envelope, false));
    const auto basic =
        readXml(xmlEffect("<basic-envelope-effect initialSharpness=\"0.25\"><control-point intensity=\"1\" "
                          "sharpness=\"0.75\" durationMs=\"10\"/></basic-envelope-effect>"));
    CHECK(basic.clip == clipOfEnvelope({0.25, {{10, 1.0, 0.75}}}, true));
    CHECK(basic.warnings ==
          std::vector<std::string>{"line 4: the last intensity is not 0; Android rejects such effects"});
}

TEST_CASE("Effects that each device has of its own are events or are named as left out", "[io][formats]")
{
    if (!readsXml())
        return;
    const auto click = readXml(xmlEffect("<predefined-effect name=\"click\" fallback=\"false\"/>"));
    CHECK(click.clip.transients.size() == 1);
    CHECK(click.clip.duration > 0.0);
    CHECK(click.warnings ==
          std::vector<std::string>{"line 3: the effect \"click\" is each device's own and is read as an event"});
    CHECK(readXml(xmlEffect("<predefined-effect name=\"double_click\"/>")).clip.transients.size() == 2);
    const auto several = readXml(xmlEffect("<primitive-effect name=\"tick\" scale=\"0.5\" delayMs=\"100\"/>"
                                           "<primitive-effect name=\"slow_rise\"/>"
                                           "<primitive-effect name=\"thud\" delayMs=\"200\" "
                                           "delayType=\"relative_start_offset\"/>"));
    REQUIRE(several.clip.transients.size() == 2);
    CHECK(several.clip.transients[0].time == Approx(0.1));
    CHECK(several.clip.transients[1].time == Approx(0.3));
    CHECK(several.clip.transients[1].sharpness < several.clip.transients[0].sharpness);
    CHECK(several.warnings.size() == 3);
    CHECK(several.warnings[1] == "line 3: the effect \"slow_rise\" is each device's own and is left out");
    CHECK(xmlErrorOf(xmlEffect("<primitive-effect name=\"spin\"/>")).ends_with("has no effect that can be read"));
    const auto chosen =
        readXml("<vibration-select><vibration-effect><vendor-effect>AAAA</vendor-effect></vibration-effect>\n"
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
    if (!readsXml())
        return;
    const auto entry = [](const std::string& attributes)
    {
        return xmlEffect("<waveform-effect><waveform-entry " + attributes + "/></waveform-effect>");
    };
    CHECK(xmlErrorOf("").starts_with("line 1: is no XML: "));
    CHECK(xmlErrorOf("<a/>") == "line 1: the root is a, but must be vibration-effect");
    CHECK(xmlErrorOf("<vibration-effect/>") == "line 1: has no effect that can be read");
    CHECK(xmlErrorOf("<vibration-select/>") == "line 1: has no vibration-effect");
    CHECK(xmlErrorOf(xmlEffect("<waveform-effect>")).starts_with("line 4: is no XML: "));
    CHECK(xmlErrorOf(xmlEffect("<waveform-effect/>")) == "line 4: waveform-effect has no entry that lasts");
    CHECK(xmlErrorOf(entry("amplitude=\"1\"")) == "line 3: has no durationMs");
    CHECK(xmlErrorOf(entry("durationMs=\"1.5\"")) == "line 3: durationMs is \"1.5\", but must be a whole number");
    CHECK(xmlErrorOf(entry("durationMs=\"-1\""))
              .starts_with("line 3: durationMs is \"-1\", but must be a number from 0"));
    CHECK(xmlErrorOf(entry("durationMs=\"1e300\"")).starts_with("line 3: durationMs is"));
    CHECK(xmlErrorOf(entry("durationMs=\"nan\"")).starts_with("line 3: durationMs is"));
    CHECK(xmlErrorOf(entry("durationMs=\"10\" amplitude=\"256\"")).starts_with("line 3: amplitude is \"256\""));
    CHECK(xmlErrorOf(
              xmlEffect("<waveform-effect><waveform-entry durationMs=\"86400000\"/><waveform-entry durationMs=\"1\"/>"
                        "</waveform-effect>")) == "line 3: ends later than 24 hours");
    CHECK(xmlErrorOf(xmlEffect("<predefined-effect/>")) == "line 3: predefined-effect has no name");
    CHECK(xmlErrorOf(xmlEffect("<waveform-effect>" + xmlStepEntries +
                               "</waveform-effect><predefined-effect name=\"click\"/>")) ==
          "line 4: predefined-effect follows waveform-effect, but a vibration-effect has only one effect");
    CHECK(xmlErrorOf(xmlEffect("<waveform-envelope-effect><control-point amplitude=\"2\" frequencyHz=\"100\" "
                               "durationMs=\"20\"/></waveform-envelope-effect>"))
              .starts_with("line 3: amplitude is \"2\""));
    CHECK(xmlErrorOf("<!DOCTYPE a [<!ENTITY b \"c\">]>\n<vibration-effect/>") ==
          "line 1: has a document type; remove it");
    std::string deep;
    for (int i = 0; i < 100'000; ++i)
        deep += "<a>";
    CHECK(xmlErrorOf("<vibration-effect>" + deep).starts_with("line 1: is no XML: "));
    const auto odd = readXml(xmlEffect("<new-effect><a/></new-effect><waveform-effect speed=\"1\">" + xmlStepEntries +
                                       "<b/></waveform-effect>"));
    CHECK(odd.clip == clipOfWaveform(xmlSteps));
    CHECK(odd.warnings == std::vector<std::string>{"line 3: new-effect cannot be read and is left out",
                                                   "line 3: speed of waveform-effect cannot be read and is left out",
                                                   "line 4: b cannot be read and is left out"});
    // Whatever is cut off is refused.
    const auto whole = xmlEffect("<waveform-effect>" + xmlStepEntries + "</waveform-effect>");
    for (std::size_t length = 0; length + 1 < whole.size(); ++length)
        CHECK_FALSE(xmlClip(std::string_view(whole).substr(0, length)));
}
